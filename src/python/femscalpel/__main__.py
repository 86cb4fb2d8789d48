# SPDX-License-Identifier: LGPL-2.1-or-later
"""python3 -m femscalpel"""

import sys

from .command_line import main

if __name__ == "__main__":
    sys.exit(main())
