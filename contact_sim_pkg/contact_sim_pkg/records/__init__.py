"""Types that everyone hands on: a rig, an effect, a topic, a case of a study. No compiler."""
