"""A node of your own that hears the bench: the largest force of a contact in each second, from whole blocks.

python examples/nodes/listener.py --ros-args -p topic:=tire/force &
bench run tire_bump
"""

import rclpy
from contact_msgs_defs.msg import BenchProgress, ContactForce
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

OVER = (BenchProgress.FINISHED, BenchProgress.STOPPED, BenchProgress.FAILED)


class Listener(Node):
    """Keeps the largest force of the second; a block holds all its samples at the full rate."""

    def __init__(self) -> None:
        super().__init__("listener")
        topic = self.declare_parameter("topic", "seat/force").value
        self.second, self.largest, self.state = 0, 0.0, BenchProgress.IDLE
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(ContactForce, topic, self.on_force, 100)
        self.create_subscription(BenchProgress, "bench/progress", self.on_progress, latched)

    def on_force(self, message: ContactForce) -> None:
        if message.header.stamp.sec != self.second:
            self.report()
            self.second, self.largest = message.header.stamp.sec, 0.0
        self.largest = max(self.largest, *message.normal)

    def on_progress(self, message: BenchProgress) -> None:
        self.state = message.state

    def report(self) -> None:
        print(f"{self.second} s: {self.largest:.0f} N", flush=True)


def main() -> None:
    """Until the run is over."""
    rclpy.init()
    node = Listener()
    while rclpy.ok() and node.state not in OVER:
        rclpy.spin_once(node, timeout_sec=0.1)
    node.report()
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
