"""What laboratories measured, one publication a file, for tables and figures to be held against."""
