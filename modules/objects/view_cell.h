#pragma once

namespace saker::objects {

/// A fitted interval of range and angle has two view cells (Measurement::view_cell): one of the
/// measurements that were corrected by the model, and one of those that were left as they are, for
/// an end is hidden or nothing was flown from there.
[[nodiscard]] constexpr int corrected_cell(int interval) { return 2 * interval; }
[[nodiscard]] constexpr int uncorrected_cell(int interval) { return 2 * interval + 1; }

/// Whether a measurement of this view cell is as the model corrects it; not of cell −1.
[[nodiscard]] constexpr bool is_corrected(int view_cell) { return view_cell % 2 == 0; }

}  // namespace saker::objects
