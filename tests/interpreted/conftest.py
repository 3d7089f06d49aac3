"""The lane without the compiler, `make test-interpreted`: kernels run as Python, whose tracebacks name the line.

Compiled kernels do not look whether an index is inside its array; NumPy does.
"""

import numba

collect_ignore_glob = [] if numba.config.DISABLE_JIT else ["test_*.py"]
