#pragma once

#include <functional>
#include <vector>

#include "saker/core/config.h"
#include "saker/simulation/sensor/ray_caster.h"
#include "saker/simulation/sensor/sensor.h"

namespace saker::simulation {

/// How a sensor answers; the defaults are an OS1's.
struct ReceiverConfig {
  double min_range_m = 0.5;
  double max_range_m = 120;
  double noise_m = 0.012;
  double noise_per_m = 0.0002;
  double beam_bias_m = 0.003;
  double divergence_mrad = 1.0;
  double mixed_share = 0.15;
  double sensitivity = 3e-6;
  double drop_share = 0.004;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("min_range_m", min_range_m, {0, 10}, "m", "nearer returns are blanked");
    v.field("max_range_m", max_range_m, {1, 500}, "m", "no return comes from farther away");
    v.field("noise_m", noise_m, {0, 1}, "m", "sd of a range: data sheets say 1 to 3 cm");
    v.field("noise_per_m", noise_per_m, {0, 0.1}, "", "growth of that with the range");
    v.field("beam_bias_m", beam_bias_m, {0, 1}, "m", "sd of the constant range error of a beam");
    v.field("divergence_mrad", divergence_mrad, {0, 20}, "mrad",
            "sd of the place of the return within the beam");
    v.field("mixed_share", mixed_share, {0, 1}, "",
            "share of beams at an edge that answer from between");
    v.field("sensitivity", sensitivity, {0, 1}, "1/m²",
            "reflectivity × cosine / range² at which 63 % of the beams answer");
    v.field("drop_share", drop_share, {0, 1}, "", "share of beams that are lost for no reason");
  }
};

/// A Velodyne HDL-64E's.
[[nodiscard]] ReceiverConfig hdl64_receiver();

/// One revolution as cast, row-major, columns in the order of time (staggered).
struct CastScan {
  int rows = 0;
  int columns = 0;
  std::vector<float> range_m;           ///< as the sensor reports it; 0: no return
  std::vector<Eigen::Vector3f> points;  ///< lidar frame at the column's time; NaN: no return
  std::vector<float> reflectivity;      ///< 0 … 1
  std::vector<std::uint16_t> labels;    ///< SemanticKITTI ids
  std::vector<ObjectId> objects;
};

/// T_world_lidar at the time of a column.
using PoseOfColumn = std::function<SE3(int column)>;
/// Called before columns are cast: brings the world to the time of the given one.
using BeforeColumn = std::function<void(int column)>;

/// Casts revolutions of one sensor through one world: where each beam goes, what comes back and how
/// far it seems.
///
/// Glass, wire and leaves let beams through; blades of grass answer before the ground; what mirrors
/// is lost unless it is met squarely; a beam at an edge may answer from between. The result is a
/// function of the arguments and the seed.
class Scanner {
 public:
  Scanner(const RayCaster& caster, const World& world, BeamTable beams,
          const ReceiverConfig& config, std::uint64_t seed);

  [[nodiscard]] CastScan cast(const PoseOfColumn& T_world_lidar, std::uint64_t scan_index,
                              const BeforeColumn& before = nullptr) const;

  static constexpr int kColumnsAtOnce = 16;

  /// The same in blocks of `kColumnsAtOnce` columns, for a world that moves meanwhile: all blocks
  /// of a scan in their order, with its `rng_of`, into its `empty_scan`.
  void cast_block(int first_column, const PoseOfColumn& T_world_lidar, core::Rng& rng,
                  CastScan& scan) const;
  [[nodiscard]] CastScan empty_scan() const;
  [[nodiscard]] core::Rng rng_of(std::uint64_t scan_index) const;

  [[nodiscard]] const BeamTable& beams() const { return beams_; }

 private:
  struct Job {
    std::vector<Shot> shots;
    std::vector<Shot> again;
    std::vector<std::size_t> which;
  };

  void aim(int column, const SE3& T_world_lidar, core::Rng& rng, std::vector<Shot>& shots) const;
  void trace(Job& job, core::Rng& rng) const;
  void mix_edges(Job& job, core::Rng& rng) const;
  void receive(const Shot& shot, int row, int column, core::Rng& rng, CastScan& scan) const;

  const RayCaster* caster_;
  const World* world_;
  BeamTable beams_;
  ReceiverConfig config_;
  core::Rng rng_;
  std::vector<float> beam_bias_;
};

}  // namespace saker::simulation
