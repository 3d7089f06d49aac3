"""Records of solved runs: their variables, where they come from, and the NetCDF files that hold them."""
