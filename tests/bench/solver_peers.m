% SPDX-License-Identifier: Apache-2.0
% Times Octave's fsolve on Appendix A's equations: solver_peers.m TRUTH.csv, one JSON line a start.
warning ("off", "Octave:singular-matrix");  % the Jacobian at zero, where Appendix A starts

function F = equations (dz1, dz2)
  lp = dx0 = dy0 = 0.02;
  F = @(x) [lp*cos(x(2)+pi/2)-dx0+x(4)*sin(x(2)+pi/2);
    x(4)*cos(x(1)+pi/2)*cos(x(2)+pi/2)-x(3)*sin(x(1)+pi/2)-lp*cos(x(1)+pi/2)*sin(x(2)+pi/2);
    x(3)*cos(x(1)+pi/2)-dz1+x(4)*cos(x(2)+pi/2)*sin(x(1)+pi/2)-lp*sin(x(1)+pi/2)*sin(x(2)+pi/2);
    lp*cos(x(2)+pi/2)+x(6)*sin(x(2)+pi/2);
    x(5)*sin(x(1)+pi/2)-dy0+x(6)*cos(x(1)+pi/2)*cos(x(2)+pi/2)-lp*cos(x(1)+pi/2)*sin(x(2)+pi/2);
    x(6)*cos(x(2)+pi/2)*sin(x(1)+pi/2)-x(5)*cos(x(1)+pi/2)-dz2-lp*sin(x(1)+pi/2)*sin(x(2)+pi/2)];
end

function measure (name, x0, truth, dz1, dz2)
  passes = 3;
  angles = zeros (size (truth));
  seconds = zeros (passes, 1);
  for pass = 1:passes
    start = cputime ();
    for i = 1:rows (truth)
      x = fsolve (equations (dz1(i), dz2(i)), x0);
      angles(i,:) = x(1:2)';
    end
    seconds(pass) = (cputime () - start) / rows (truth);
  end
  errors = max (abs (mod (angles - truth + pi, 2*pi) - pi), [], 2);
  printf (['{"name": "octave_fsolve/%s", "s_per_solve": %.6g, ' ...
           '"wrong_roots": %d, "worst_rad": %.6g}\n'],
          name, median (seconds), sum (! (errors <= 1e-3)), max (errors));
end

columns = dlmread (argv (){1}, ",", 1, 0);
truth = columns(:,3:4);  % seq,t_us,theta1_rad,theta2_rad,...
% Z of the disc under the sensors, from the plane rod . p = lp.
rod_x = -sin (truth(:,2));
rod_y = sin (truth(:,1)) .* cos (truth(:,2));
rod_z = -cos (truth(:,1)) .* cos (truth(:,2));
dz1 = (0.02 - 0.02 * rod_x) ./ rod_z;
dz2 = (0.02 - 0.02 * rod_y) ./ rod_z;
measure ("from_zero", [0;0;0;0;0;0], truth, dz1, dz2);
measure ("from_rest", [0;0;0;0.02;0.02;0], truth, dz1, dz2);
