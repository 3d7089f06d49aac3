"""The words of a verdict; reading them loads nothing that is slow to start."""

SUPPORTED, REFUTED, OPEN = "supported", "not supported", "not decided"
