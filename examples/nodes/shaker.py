"""A shaker of your own: this node sends `platform/vibration` in place of the bench's. Change `acceleration`.

Start the simulator and the logger by themselves, then this; the three find each other in any order:

    python -P -m contact_sim_pkg.nodes.contact_simulator --ros-args -p scene:=seat_ride &
    python -P -m contact_sim_pkg.nodes.bag_logger --ros-args -p scene:=seat_ride -p bag:=bags/shaken &
    python examples/nodes/shaker.py
"""

import math

import rclpy
from contact_msgs_defs.msg import BenchProgress, BenchRecorded, VibrationBlock
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

BLOCK = 0.01  # [s] `block_length` of the scene
STEP = 0.001  # [s] between samples: 1 / `vibration.sample_rate` of the scene
AHEAD = 24  # blocks that may be sent before simulator and logger have answered for them
GOING = (BenchProgress.READY, BenchProgress.RUNNING)
OVER = (BenchProgress.FINISHED, BenchProgress.STOPPED, BenchProgress.FAILED)


def acceleration(time: float) -> float:
    """Of the floor, upwards, without gravity [m/s^2], at a time [s]: a pure function, so that a run can be made again."""
    return 1.5 * math.sin(2.0 * math.pi * 4.0 * time)


class Shaker(Node):
    """Sends numbered blocks in order, as far ahead as the run allows."""

    def __init__(self) -> None:
        super().__init__("shaker")
        self.sent, self.done, self.recorded, self.blocks = 0, -1, -1, 0
        self.state, self.closed = BenchProgress.IDLE, False
        self.entry = self.create_publisher(VibrationBlock, "platform/vibration", 2 * AHEAD)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(BenchProgress, "bench/progress", self.on_progress, latched)
        self.create_subscription(BenchRecorded, "bench/recorded", self.on_recorded, latched)

    def on_progress(self, message: BenchProgress) -> None:
        self.state, self.done, self.blocks = message.state, message.block, message.blocks

    def on_recorded(self, message: BenchRecorded) -> None:
        self.recorded, self.closed = message.block, message.closed

    def send_due(self) -> None:
        """Send what may be sent now. Block 0 waits until simulator and logger are both matched."""
        if self.state not in GOING or (self.sent == 0 and self.entry.get_subscription_count() < 2):
            return
        while self.sent < self.blocks and self.sent <= min(self.done, self.recorded) + AHEAD:
            self.entry.publish(self.block(self.sent))
            self.sent += 1

    def block(self, number: int) -> VibrationBlock:
        """One block: its last sample lies at its end and equals the first of the next."""
        count = round(BLOCK / STEP)
        start = number * round(BLOCK * 1e9)  # [ns]
        message = VibrationBlock(block=number, sample_period=STEP, samples=count + 1)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(start, 10**9)
        message.acceleration_x = [0.0] * (count + 1)
        message.acceleration_z = [acceleration((number * count + place) * STEP) for place in range(count + 1)]
        return message


def main() -> None:
    """Until the run is over and its bag closed."""
    rclpy.init()
    node = Shaker()
    while rclpy.ok() and not (node.state in OVER and node.closed):
        rclpy.spin_once(node, timeout_sec=0.01)
        node.send_due()
    print(f"{node.sent} blocks sent")
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
