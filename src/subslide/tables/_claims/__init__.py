"""The paper's claims: evidence from tables, verdicts on it, and the claims on grains and on the water's surface."""
