"""Somebody on the sensor's network, or on the bus, in flight: what is sent is refused and named, and the flight goes on.

Packets are forged by the sensor's own address and ports (sensor_attacker.cc), or come a hundred times as fast.
"""

import os
import re
import subprocess
import tempfile
import unittest

from fault_flight import BIN, Flight

ATTACKED = 4      # s
LIDAR_FLOOD = 32000  # packets a second: a hundred times the sensor's
IMU_FLOOD = 10000
STOPS = re.compile(r"→ (hold|land|descend|done)\w*: .*")


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class SensorAttack(unittest.TestCase):
    def attack(self, command, says, *, may_hold=False):
        holder = tempfile.TemporaryDirectory(prefix="saker_attack_")
        self.addCleanup(holder.cleanup)
        flight = Flight(holder.name)
        self.addCleanup(flight.end)
        begin = flight.fly_fast()
        quiet = len(STOPS.findall(flight.log("saker-flight")))
        attacker = subprocess.Popen([BIN / command[0], *(word.format(site=flight.site) for word in command[1:])],
                                    stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(attacker.wait)
        self.addCleanup(attacker.kill)
        end = flight.wait_for_row(lambda row: row.t > begin.t + ATTACKED or not row.armed, 4 * ATTACKED, "flight")
        stops = [stop.group() for stop in STOPS.finditer(flight.log("saker-flight"))][quiet:]
        cpu = re.findall(r"([0-9.]+) CPU", flight.log("saker-flight"))
        print(f"{self._testMethodName}: {'flies' if end.flying and not end.landing else 'down'}, {stops}, CPU {cpu}")
        self.assertEqual(end.collisions, 0, flight.logs())
        self.assertTrue(end.flying, flight.logs())
        if not may_hold:
            self.assertEqual(stops, [], flight.logs())
            self.assertFalse(end.landing, flight.logs())
        if says:
            flight.wait(lambda: re.search(says, flight.log("saker-flight")), 8, says)
        return flight

    def packets(self, mode, rate, says, **more):
        return self.attack(("sensor_attacker", "{site}/metadata.json", mode, str(rate), str(ATTACKED)), says, **more)

    # Hazard: Sensor | forged inertial stamps far off | refused, counted and named; clock and pose are not moved | –
    def test_inertial_stamp_far_off(self):
        self.packets("imu_far", 20, "sensor: refused [0-9]+ packets stamped ahead of time")

    # Hazard: Sensor | forged inertial stamps 5 s ahead | refused; real samples are not shut out | –
    def test_inertial_stamp_five_seconds_ahead(self):
        self.packets("imu_ahead", 20, "sensor: refused [0-9]+ packets stamped ahead of time")

    # Hazard: Sensor | forged frame numbers | refused; no scan is closed by them | –
    def test_forged_frame_number(self):
        self.packets("frame", 20, "sensor: refused [0-9]+ packets of a frame that is not due")

    # Hazard: Sensor | a second sensor on the same ports | dropped by its address, counted | –
    def test_second_sensor(self):
        self.packets("second", 320, "sensor: the kernel dropped [0-9]+ packets of others")

    # Hazard: Sensor | a flood of 100 times the rate on the lidar port | dropped by the kernel | –
    def test_flood_on_the_lidar_port(self):
        self.packets("flood_lidar", LIDAR_FLOOD, "sensor: the kernel dropped [0-9]+ packets of others")

    # Hazard: Sensor | the same on the inertial port | dropped by the kernel | –
    def test_flood_on_the_inertial_port(self):
        self.packets("flood_imu", IMU_FLOOD, "sensor: the kernel dropped [0-9]+ packets of others")

    # Hazard: Sensor | a flood from the sensor's own address | each turn has a budget: packets are lost, not the flight | –
    def test_flood_by_the_sensors_own_address(self):
        """Real packets are lost with the others: it may hold, it does not fall."""
        self.packets("flood_imu_copied", IMU_FLOOD, "sensor: refused [0-9]+ packets", may_hold=True)

    # Hazard: Stages and links | a flood on a channel of the bus | 128 messages a turn; the others wait or are lost | –
    def test_flood_on_the_bus(self):
        count = str(LIDAR_FLOOD * ATTACKED)
        self.attack(("lcm_probe", "say", "udpm://239.255.76.67:7667?ttl=0", "R1_VERDICT", "00" * 100, count,
                     str(LIDAR_FLOOD)), None)


if __name__ == "__main__":
    unittest.main()
