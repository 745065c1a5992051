# SPDX-License-Identifier: Apache-2.0
# run_in_guest.py TEST [NAME=VALUE ...]: one test in a guest of its own, in virtual time; shows its console.
# GUEST_LIMIT_S bounds it; GUEST_SYSTEMD=1 has it run beside systemd's services. Status 77: something is missing.
import os
import sys

import guest

SKIP = 77

if (reason := guest.missing()) is not None:
    print(f"skipped: {reason}")
    sys.exit(SKIP)
ending = guest.boot(sys.argv[1], limit_s=float(os.environ.get("GUEST_LIMIT_S", "240")),
                    systemd=os.environ.get("GUEST_SYSTEMD") == "1",
                    **dict(word.split("=", 1) for word in sys.argv[2:]))
print(ending.console)
print(f"The guest {ending.outcome}.")
sys.exit(0 if ending.outcome == "passed" else 1)
