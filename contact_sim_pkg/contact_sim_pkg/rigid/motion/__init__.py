"""Motion in time: event-located, fixed-step and compliant."""
