"""Golden numbers for the tests of every implementation, a module for each kind; `make_golden.py` writes their files."""
