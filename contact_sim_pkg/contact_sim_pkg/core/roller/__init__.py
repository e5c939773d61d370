"""A roller on a rotating shaft: contact that changes in time, tilt and yaw that can lose their stability, a track that waves."""
