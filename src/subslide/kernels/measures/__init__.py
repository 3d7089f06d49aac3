"""What is measured of a state at every step: one file each, compiled into the time loop."""
