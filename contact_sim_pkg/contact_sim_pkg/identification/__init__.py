"""What the motion of a rigid body in frictional contact tells of its inertia and its impulses. numpy and scipy only."""
