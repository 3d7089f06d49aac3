"""What is asked: a study read and checked, how each run is to be solved, and in which batch."""
