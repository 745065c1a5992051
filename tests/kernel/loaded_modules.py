# SPDX-License-Identifier: Apache-2.0
# loaded_modules.py TEST...: prints the files of Python's own modules that the tests load.
import importlib.util
import pathlib
import sys

for path in sys.argv[1:]:
    sys.path.insert(0, str(pathlib.Path(path).parent))
    spec = importlib.util.spec_from_file_location(pathlib.Path(path).stem, path)
    spec.loader.exec_module(importlib.util.module_from_spec(spec))

for module in list(sys.modules.values()):
    for file in (getattr(module, "__file__", None), getattr(module, "__cached__", None)):
        if file is not None and file.startswith("/usr/lib/") and pathlib.Path(file).exists():
            print(file)
