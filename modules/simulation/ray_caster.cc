#include "simulation/ray_caster.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>

#include "core/error.h"

namespace saker::simulation {
namespace {

/// One thread: the caster's callers decide about threads.
RTCDevice new_device() {
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  if (device == nullptr) throw Error("simulation: Embree found no device on this machine");
  return device;
}

RTCGeometry triangles_of(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           3 * sizeof(float), mesh.vertices.size());
  std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * 3 * sizeof(float));
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(unsigned), mesh.triangles.size());
  std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(unsigned));
  rtcCommitGeometry(geometry);
  return geometry;
}

void attach(RTCScene scene, RTCGeometry geometry) {
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

RTCScene scene_of(RTCDevice device, const Mesh& mesh) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  attach(scene, triangles_of(device, mesh));
  rtcCommitScene(scene);
  return scene;
}

RTCGeometry instance_of(RTCDevice device, RTCScene prototype, const Placement& placement) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, prototype);
  const Eigen::Matrix4f matrix = placement.T_world_prototype.matrix();
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, matrix.data());
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCRayHit ray_of(const Shot& shot, float far) {
  RTCRayHit ray{};
  ray.ray.org_x = shot.origin.x();
  ray.ray.org_y = shot.origin.y();
  ray.ray.org_z = shot.origin.z();
  ray.ray.dir_x = shot.direction.x();
  ray.ray.dir_y = shot.direction.y();
  ray.ray.dir_z = shot.direction.z();
  ray.ray.tnear = shot.near;
  ray.ray.tfar = far;
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace

struct RayCaster::Scene {
  explicit Scene(const World& made_of)
      : world(&made_of), device(new_device()), top(rtcNewScene(device)) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    rtcReleaseScene(top);
    for (RTCScene prototype : prototypes) rtcReleaseScene(prototype);
    rtcReleaseDevice(device);
  }

  const World* world;
  RTCDevice device;
  RTCScene top;
  std::vector<RTCScene> prototypes;
};

RayCaster::RayCaster(const World& world) : scene_(std::make_unique<Scene>(world)) {
  Scene& s = *scene_;
  for (const Mesh& mesh : world.prototypes) s.prototypes.push_back(scene_of(s.device, mesh));
  attach(s.top, triangles_of(s.device, world.mesh));  // geometry 0; placement i is geometry i + 1
  for (const Placement& placement : world.placements) {
    attach(s.top, instance_of(s.device, s.prototypes[placement.prototype], placement));
  }
  rtcCommitScene(s.top);
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

namespace {

/// What triangle was met, of which object.
void read_hit(const World& world, const RTCRayHit& ray, Shot& shot) {
  shot.hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  if (!shot.hit) return;
  shot.distance = ray.ray.tfar;
  Eigen::Vector3f normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  const bool instanced = ray.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  if (instanced) {
    const Placement& placement = world.placements[ray.hit.instID[0] - 1];
    normal = placement.T_world_prototype.linear().inverse().transpose() * normal;
    shot.material = world.prototypes[placement.prototype].materials[ray.hit.primID];
    shot.object = placement.object;
  } else {
    shot.material = world.mesh.materials[ray.hit.primID];
    shot.object = world.mesh.objects[ray.hit.primID];
  }
  const float length = normal.norm();
  shot.cosine = length > 0 ? std::abs(normal.dot(shot.direction)) / length : 0;
}

}  // namespace

void RayCaster::cast(std::span<Shot> shots, float far) const {
  constexpr std::size_t kBlock = 256;
  std::array<RTCRayHit, kBlock> rays;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < shots.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, shots.size() - first);
    for (std::size_t i = 0; i < count; ++i) rays[i] = ray_of(shots[first + i], far);
    rtcIntersect1M(scene_->top, &context, rays.data(), static_cast<unsigned>(count),
                   sizeof(RTCRayHit));
    for (std::size_t i = 0; i < count; ++i) read_hit(*scene_->world, rays[i], shots[first + i]);
  }
}

}  // namespace saker::simulation
