#include "tools/plant/simulated_plant.h"

#include <utility>

namespace saker::tools {

std::vector<autonomy::SensorPacket> SimulatedPlant::take_packets() {
  std::vector<autonomy::SensorPacket> packets;
  for (simulation::SensorDatagram& datagram : vehicle_.take_packets()) {
    packets.push_back({datagram.received, std::move(datagram.payload)});
  }
  return packets;
}

}  // namespace saker::tools
