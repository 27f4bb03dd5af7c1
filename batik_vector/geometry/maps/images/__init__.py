"""Images of regions and lines under a map: functions of a :class:`~batik_vector.geometry.maps.FlameMap`.

The map itself is a value; what it makes of whole curves is worked out here.
"""
