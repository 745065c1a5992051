// SPDX-License-Identifier: Apache-2.0
// rig_image RIG.toml IMAGE gn|ekf: the image that a host uploads, for the tests of the boards.
#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "host/rig_file.hpp"
#include "host/rig_image.hpp"

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: rig_image RIG.toml IMAGE gn|ekf\n");
    return 2;
  }
  const auto rig = penduline::read_rig_file(argv[1]);
  const auto estimator = argv[3] == std::string_view("ekf")
                             ? penduline::wire::OnboardEstimator::kKalman
                             : penduline::wire::OnboardEstimator::kGaussNewton;
  const auto image =
      rig ? penduline::rig_image(rig->rig, estimator, argv[1]) : tl::unexpected(rig.error());
  if (!image) {
    fmt::print(stderr, "error: {}\n", image.error().message);
    return 1;
  }
  std::ofstream file(argv[2], std::ios::binary);
  for (const std::uint8_t byte : *image) {
    file.put(static_cast<char>(byte));
  }
  return file.flush() ? 0 : 1;
}
