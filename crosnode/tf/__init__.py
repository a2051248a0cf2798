"""Coordinate frames: told on ``/tf`` and ``/tf_static``, and looked up, a step in each cycle."""
