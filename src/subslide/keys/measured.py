"""What a run may be asked for beside its series and profiles; entries of the keys that ask for it."""

from typing import Any

MOST_GAUGES, MOST_DIRECTIONS = 100, 3600

ENTRIES: dict[str, dict[str, Any]] = {
    "fields": {
        "description": "keep h2 and eta over the plane at each snapshot (plane models only, which auto then takes)",
        "type": "boolean",
        "default": False,
    },
    "gauges": {
        "description": "places [x, y] where the surface, h2 and the velocities of both layers are kept at every sample"
        " (`gauge_eta`, ...; not with keep: summary); linear between centres of cells, so that gauges along x see what"
        " profiles show. --gauges 0.1,0;0.2,0.1 on the command line",
        "type": "array",
        "items": {
            "type": "array",
            "items": {"type": "number", "minimum": -1e9, "maximum": 1e9},
            "minItems": 2,
            "maxItems": 2,
        },
        "maxItems": MOST_GAUGES,
        "uniqueItems": True,
        "allowed": f"a list of at most {MOST_GAUGES} places [x, y] in the box",
        "default": [],
        "unit": "m",
    },
    "runout_directions": {
        "description": "equal angles, the first along x, in which the runout of the deposit is measured (`runout`,"
        " largest and where, area and centroid: not of scenes on a line); 0 for none",
        "type": "integer",
        "minimum": 0,
        "maximum": MOST_DIRECTIONS,
        "default": 0,
        "unit": "1",
    },
    "footprints": {
        "description": "keep of each cell its largest h2 and |eta| over all steps, and when each first came to 1 % of"
        " H2 (`largest_h2`, `arrival_h2`, ...; only with keep: all)",
        "type": "boolean",
        "default": False,
    },
}
"""Entries by key, but for their role; none of a run's other answers depends on them."""
