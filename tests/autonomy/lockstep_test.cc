#include "saker/autonomy/lockstep.h"

#include <gtest/gtest.h>

#include <sstream>

#include "made_flight.h"
#include "saker/objects/comparison.h"
#include "saker/objects/map_io.h"

namespace saker::autonomy {
namespace {

void put(std::ostream& out, const SE3& T) { out << T.matrix() << '\n'; }

/// Writes down everything that a run says, to the last digit.
class Scribe : public LockstepObserver {
 public:
  Scribe() { text_.precision(17); }
  void on_scan(const ScanRecord& record, const odometry::OdometryEstimate& estimate) override {
    text_ << record.name << ' ' << record.stamp << ' ' << to_string(record.status) << ' '
          << estimate.points.size() << '\n';
    put(text_, record.T_odom_lidar);
  }
  void on_detections(const objects::Detections& detections) override {
    for (const objects::Measurement& m : detections.measurements) {
      text_ << m.stamp << ' ' << int(m.class_id) << ' ' << m.points << ' ' << m.moving << ' '
            << objects::place(m.model).transpose() << '\n'
            << m.covariance << '\n';
      ++measurements_;
    }
  }
  [[nodiscard]] std::string text() const { return text_.str(); }
  [[nodiscard]] int measurements() const { return measurements_; }

 private:
  std::ostringstream text_;
  int measurements_ = 0;
};

struct FinishedRun {
  LockstepResult result;
  std::string said;  ///< scans, detections, corrected trajectory and map
  int measurements = 0;
};

FinishedRun run(lidar::ScanSource& source, int threads) {
  const Config config;
  core::Timings timings;
  Lockstep lockstep(config, threads, timings);
  Scribe scribe;
  FinishedRun run{lockstep.run(source, scribe), "", scribe.measurements()};
  std::ostringstream trajectory;
  trajectory.precision(17);
  for (const SE3& T : run.result.T_world_lidar) put(trajectory, T);
  run.said = scribe.text() + trajectory.str() + objects::to_json(run.result.map, config.objects);
  return run;
}

class LockstepTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    flight_ = std::make_unique<MadeFlight>();
    const auto source = flight_->open();
    reference_ = std::make_unique<FinishedRun>(run(*source, 1));
  }
  static void TearDownTestSuite() {
    flight_.reset();
    reference_.reset();
  }

  static std::unique_ptr<MadeFlight> flight_;
  static std::unique_ptr<FinishedRun> reference_;  // on one thread
};

std::unique_ptr<MadeFlight> LockstepTest::flight_;
std::unique_ptr<FinishedRun> LockstepTest::reference_;

TEST_F(LockstepTest, SaysTheSameToTheByteOnAnyNumberOfThreadsAndEveryTime) {
  EXPECT_GT(reference_->measurements, 10) << "otherwise little is compared";
  for (const int threads : {1, 2, 3}) {
    const auto source = flight_->open();
    EXPECT_TRUE(run(*source, threads).said == reference_->said) << threads << " threads";
  }
}

TEST_F(LockstepTest, HasAPoseForEveryScanAndRunsItsStagesAtTheirRates) {
  const LockstepResult& result = reference_->result;
  ASSERT_EQ(result.scans.size(), MadeFlight::kScans);
  EXPECT_EQ(result.T_world_lidar.size(), result.scans.size());
  EXPECT_EQ(result.labelled_scans, MadeFlight::kScans / 2);
  EXPECT_NEAR(result.slam_cycles, MadeFlight::kScans / 5, 1);
  for (const ScanRecord& scan : result.scans) {
    EXPECT_EQ(scan.status, odometry::OdometryStatus::ok) << scan.name;
  }
}

TEST_F(LockstepTest, FindsVehiclesWhereTheyAre) {
  const objects::ClassTable table;
  const objects::ObjectMap truth = objects::read_map(flight_->truth(), table);
  const auto classes = objects::compare(reference_->result.map, truth, table, {});
  ASSERT_EQ(classes[0].name, "vehicle");
  EXPECT_GE(classes[0].found, 3);
  EXPECT_LE(classes[0].invented, classes[0].found / 2);
}

TEST_F(LockstepTest, GoesOnAfterScansThatCannotBeUsed) {
  FaultySource source(flight_->open(), 12, 17);
  const LockstepResult result = run(source, 2).result;
  ASSERT_EQ(result.scans.size(), MadeFlight::kScans);
  EXPECT_EQ(result.scans[12].fault, "cut off");
  EXPECT_EQ(result.scans[17].fault, "");
  for (int i = 0; i < MadeFlight::kScans; ++i) {
    const bool good = i != 12 && i != 17;
    EXPECT_EQ(result.scans[i].status == odometry::OdometryStatus::ok, good) << i;
    EXPECT_TRUE(result.T_world_lidar[i].matrix().allFinite()) << i;
    const SE3& undisturbed = reference_->result.scans[i].T_odom_lidar;
    EXPECT_LT((result.scans[i].T_odom_lidar.translation() - undisturbed.translation()).norm(), 0.3)
        << i;
  }
  EXPECT_FALSE(result.map.objects.empty());
}

}  // namespace
}  // namespace saker::autonomy
