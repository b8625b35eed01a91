#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace saker::lidar {

/// The simplex method of Nelder and Mead ("A simplex method for function minimization", 1965) for
/// functions without a gradient, upwards.
/// \param begin        where the search starts
/// \param steps        to the simplex's other corners; an unknown whose step is 0 stays
/// \param evaluations  of `value`, about
/// \return the best corner
template <class Value, int N>
[[nodiscard]] Eigen::Matrix<float, N, 1> maximise(const Value& value,
                                                  const Eigen::Matrix<float, N, 1>& begin,
                                                  const Eigen::Matrix<float, N, 1>& steps,
                                                  int evaluations) {
  using Vector = Eigen::Matrix<float, N, 1>;
  struct Corner {
    Vector at;
    float value;
  };
  const auto corner = [&](const Vector& at) { return Corner{at, value(at)}; };
  std::array<Corner, N + 1> simplex;
  simplex[0] = corner(begin);
  for (int k = 0; k < N; ++k) simplex[k + 1] = corner(begin + steps[k] * Vector::Unit(k));
  Corner& worst = simplex[N];
  for (int used = N + 1;; used += 2) {
    std::stable_sort(simplex.begin(), simplex.end(),
                     [](const Corner& a, const Corner& b) { return a.value > b.value; });
    if (used >= evaluations) return simplex[0].at;
    Vector middle = Vector::Zero();
    for (int k = 0; k < N; ++k) middle += simplex[k].at / static_cast<float>(N);
    const Corner reflected = corner(2 * middle - worst.at);
    if (reflected.value > simplex[0].value) {
      const Corner expanded = corner(3 * middle - 2 * worst.at);
      worst = expanded.value > reflected.value ? expanded : reflected;
      continue;
    }
    if (reflected.value > simplex[N - 1].value) {
      worst = reflected;
      continue;
    }
    if (reflected.value > worst.value) worst = reflected;
    const Corner contracted = corner(0.5F * (middle + worst.at));
    if (contracted.value > worst.value) {
      worst = contracted;
      continue;
    }
    for (int k = 1; k <= N; ++k) simplex[k] = corner(0.5F * (simplex[0].at + simplex[k].at));
    used += N;
  }
}

}  // namespace saker::lidar
