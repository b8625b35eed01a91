#pragma once

#include <Eigen/Core>
#include <vector>

namespace saker::objects {

/// One-to-one assignment of rows to columns with the most pairs whose cost is at most `gate`, and
/// among those the least sum of costs: the Hungarian method with potentials (Kuhn; Jonker and
/// Volgenant 1987), O(n³). \return for each row its column, or −1.
[[nodiscard]] std::vector<int> assign(const Eigen::MatrixXd& cost, double gate);

}  // namespace saker::objects
