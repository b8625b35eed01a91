#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "flight/bus/mailbox.h"
#include "flight/executive/shared_clock.h"
#include "saker/autonomy/mission.h"
#include "saker/autonomy/pipeline.h"
#include "saker/autonomy/planning.h"

namespace saker::flight {

/// A registered scan's pose, for the pose of the body and for SLAM.
struct PoseFix {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  Matrix6d covariance = Matrix6d::Constant(NAN);
  bool registered = false;
};

/// What the safety loop orders of the others.
struct Orders {
  autonomy::MissionOrders orders;
  int anchors = 0;  ///< counts how often guidance was to begin anew
  Time stamp = 0;   ///< of the run of safety that ordered it
};

/// Of the newest map, what safety looks at.
struct MapNews {
  Time stamp = 0;
  SE3 T_world_odom = SE3::Identity();
  double classified_share = NAN;
};

/// All that stands between the loops of the executive: newest values, and queues with a ceiling.
/// What guidance and safety touch is copied (ValueBox) or a number; other loops may share.
struct Blackboard {
  SharedClock clock;

  // From the network.
  ValueBox<VehicleState> vehicle;
  BoundedQueue<CommandAck> acks{64};
  BoundedQueue<autonomy::Order> operator_orders{16};
  ValueBox<motion::Verdict> verdict;
  Mailbox<occupancy::OccupancyGrid> grid;
  std::atomic<Time> newest_grid = 0;

  // From the sensor: 2048 lidar packets are three seconds.
  BoundedQueue<std::vector<std::uint8_t>> packets{2048};
  BoundedQueue<lidar::ImuSample> imu{1024};
  std::atomic<Time> newest_scan = 0;
  std::atomic<Time> newest_registered = 0;

  // From ingestion to pose, segmentation and mapping; from segmentation to mapping.
  BoundedQueue<PoseFix> pose_fixes{32};
  BoundedQueue<PoseFix> motions{1024};
  Mailbox<autonomy::IngestedScan> scan;
  BoundedQueue<detection::LabelledScan> labelled{32};
  Mailbox<autonomy::MapSnapshot> map;
  ValueBox<MapNews> map_news;
  ValueBox<VehicleOdometry> odometry;
  ValueBox<autonomy::Contact> contact;

  // Planning, guidance, safety.
  Mailbox<autonomy::Planning::Output> plan;
  ValueBox<autonomy::PlanningReport> report;  // the plan's
  Mailbox<motion::Trajectory> committed;
  ValueBox<Setpoint> setpoint;
  ValueBox<autonomy::GuidanceStop> stop;
  std::atomic<Time> guided = 0;  // the last run of guidance that ended
  ValueBox<Orders> orders;
  Mailbox<autonomy::OrderReply> order_reply;
  BoundedQueue<autonomy::MissionEvent> events{64};
  std::atomic<bool> marked = false;  // by the main thread: before that nothing arms
  std::atomic<bool> mission_done = false;
};

}  // namespace saker::flight
