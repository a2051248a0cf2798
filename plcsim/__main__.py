"""``python -m plcsim`` is ``plcsim``."""

import sys

from plcsim.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
