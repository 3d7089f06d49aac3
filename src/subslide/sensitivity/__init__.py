"""What the answers of many runs owe to each parameter: Sobol' indices, main effects, power laws."""
