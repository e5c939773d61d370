"""Published bytes arrive at a raw subscription as they were encoded; the graph reports the hash that a bag keeps."""

import pytest
from tests.bench_process import wait_until

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.typestore import type_hash
from contact_sim_pkg.run.outputs import wrench_of

pytestmark = pytest.mark.ros


def test_a_raw_subscription_gets_the_encoded_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    import rclpy
    from geometry_msgs.msg import WrenchStamped
    from rclpy.executors import SingleThreadedExecutor

    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=101)
    try:
        node = rclpy.create_node("bytes", namespace="bag_bytes", context=context)
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        received: list[bytes] = []
        node.create_subscription(WrenchStamped, "wrench", received.append, 10, raw=True)
        publisher = node.create_publisher(WrenchStamped, "wrench", 10)
        wait_until(lambda: (executor.spin_once(timeout_sec=0.05), publisher.get_subscription_count())[1])
        wrench = wrench_of((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
        sent = [encode(wrench, 10**9 + length, "t" * length) for length in range(6)]
        for data in sent:
            publisher.publish(data)
        wait_until(lambda: (executor.spin_once(timeout_sec=0.05), len(received) == len(sent))[1])
        (publisher_info,) = node.get_publishers_info_by_topic("/bag_bytes/wrench")
        executor.shutdown()
        node.destroy_node()
    finally:
        rclpy.shutdown(context=context)
    assert received == sent
    assert str(publisher_info.topic_type_hash) == type_hash("geometry_msgs/msg/WrenchStamped")
