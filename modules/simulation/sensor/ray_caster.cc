#include "saker/simulation/sensor/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "saker/core/error.h"
#include "saker/simulation/world/triangle.h"

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

/// Watertight where triangles meet, on every instruction set: a ray along an edge hits one of them.
RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

RTCScene scene_of(RTCDevice device, const Mesh& mesh) {
  RTCScene scene = new_scene(device);
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

/// A placed prototype: what a hit on it belongs to.
struct Instance {
  const Mesh* mesh;
  Eigen::Matrix3f normal_matrix;  ///< inverse transpose of its transform
  ObjectId object;
};

Instance instance_for(const World& world, const Placement& placement) {
  return {&world.prototypes[placement.prototype],
          placement.T_world_prototype.linear().inverse().transpose(), placement.object};
}

}  // namespace

struct RayCaster::Scene {
  explicit Scene(const World& made_of)
      : world(&made_of),
        device(new_device()),
        still(new_scene(device)),
        moving(new_scene(device)) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    for (RTCGeometry mover : mover_geometries) rtcReleaseGeometry(mover);
    rtcReleaseScene(moving);
    rtcReleaseScene(still);
    for (RTCScene prototype : prototypes) rtcReleaseScene(prototype);
    rtcReleaseDevice(device);
  }

  void add_still(const Placement& placement) {
    attach(still, instance_of(device, prototypes[placement.prototype], placement));
    placed.push_back(instance_for(*world, placement));
  }
  void add_mover(const Placement& placement) {
    RTCGeometry geometry = instance_of(device, prototypes[placement.prototype], placement);
    rtcAttachGeometry(moving, geometry);
    mover_geometries.push_back(geometry);
    movers.push_back(instance_for(*world, placement));
  }

  const World* world;
  RTCDevice device;
  RTCScene still;   ///< geometry 0: the world's mesh; placement i is geometry i + 1
  RTCScene moving;  ///< mover i is geometry i
  std::vector<RTCScene> prototypes;
  std::vector<Instance> placed;
  std::vector<Instance> movers;
  std::vector<RTCGeometry> mover_geometries;
};

RayCaster::RayCaster(const World& world) : scene_(std::make_unique<Scene>(world)) {
  Scene& s = *scene_;
  for (const Mesh& mesh : world.prototypes) s.prototypes.push_back(scene_of(s.device, mesh));
  attach(s.still, triangles_of(s.device, world.mesh));
  for (const Placement& placement : world.placements) s.add_still(placement);
  for (const Placement& mover : world.movers) s.add_mover(mover);
  rtcCommitScene(s.still);
  rtcCommitScene(s.moving);
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

void RayCaster::move(std::size_t index, const Eigen::Affine3f& T_world_prototype) {
  RTCGeometry geometry = scene_->mover_geometries[index];
  const Eigen::Matrix4f matrix = T_world_prototype.matrix();
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, matrix.data());
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene_->moving);
  scene_->movers[index].normal_matrix = T_world_prototype.linear().inverse().transpose();
}

namespace {

void read_instance(const Instance& instance, const RTCRayHit& ray, Shot& shot) {
  const Eigen::Vector3f normal =
      instance.normal_matrix * Eigen::Vector3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  shot.material = instance.mesh->materials[ray.hit.primID];
  shot.object = instance.object;
  shot.distance = ray.ray.tfar;
  shot.cosine = std::abs(normal.dot(shot.direction)) / std::max(normal.norm(), 1e-12F);
}

/// What triangle of what stands still was met, of which object.
void read_hit(const Mesh& mesh, std::span<const Instance> placed, const RTCRayHit& ray,
              Shot& shot) {
  shot.hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  if (!shot.hit) return;
  if (ray.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
    read_instance(placed[ray.hit.instID[0] - 1], ray, shot);
    return;
  }
  const Eigen::Vector3f normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  shot.material = mesh.materials[ray.hit.primID];
  shot.object = mesh.objects[ray.hit.primID];
  shot.distance = ray.ray.tfar;
  shot.cosine = std::abs(normal.dot(shot.direction)) / std::max(normal.norm(), 1e-12F);
}

}  // namespace

void RayCaster::cast(std::span<Shot> shots, float far) const {
  constexpr std::size_t kBlock = 256;
  const Scene& s = *scene_;
  std::array<RTCRayHit, kBlock> rays;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  // The same hits as with COHERENT to the bit, in three quarters of the time: crowns scatter rays.
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  for (std::size_t first = 0; first < shots.size(); first += kBlock) {
    const auto count = static_cast<unsigned>(std::min(kBlock, shots.size() - first));
    for (unsigned i = 0; i < count; ++i) rays[i] = ray_of(shots[first + i], far);
    rtcIntersect1M(s.still, &context, rays.data(), count, sizeof(RTCRayHit));
    for (unsigned i = 0; i < count; ++i)
      read_hit(s.world->mesh, s.placed, rays[i], shots[first + i]);
    if (s.movers.empty()) continue;
    for (unsigned i = 0; i < count; ++i) rays[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1M(s.moving, &context, rays.data(), count, sizeof(RTCRayHit));
    for (unsigned i = 0; i < count; ++i) {
      if (rays[i].hit.instID[0] == RTC_INVALID_GEOMETRY_ID) continue;
      shots[first + i].hit = true;
      read_instance(s.movers[rays[i].hit.instID[0]], rays[i], shots[first + i]);
    }
  }
}

namespace {

/// A point query under way in one of the two scenes.
struct Search {
  const Mesh* mesh = nullptr;           ///< what is not placed
  std::span<const Instance> instances;  ///< what is: the first is geometry `first_instance`
  unsigned first_instance = 0;
  Eigen::Vector3f point;
  const std::vector<bool>* ignored = nullptr;
  NearSurface found;
};

bool consider(RTCPointQueryFunctionArguments* args) {
  auto& search = *static_cast<Search*>(args->userPtr);
  const bool placed = args->context->instStackSize > 0;
  const Instance* instance =
      placed ? &search.instances[args->context->instID[0] - search.first_instance] : nullptr;
  const Mesh& mesh = placed ? *instance->mesh : *search.mesh;
  const MaterialId material = mesh.materials[args->primID];
  if ((*search.ignored)[material]) return false;
  Eigen::Affine3f T = Eigen::Affine3f::Identity();
  if (placed) T.matrix() = Eigen::Map<const Eigen::Matrix4f>(args->context->inst2world[0]);
  const auto& corners = mesh.triangles[args->primID];
  const Eigen::Vector3f at =
      closest_on_triangle(search.point, T * mesh.vertices[corners[0]],
                          T * mesh.vertices[corners[1]], T * mesh.vertices[corners[2]]);
  const float distance = (at - search.point).norm();
  if (distance >= args->query->radius) return false;
  args->query->radius = distance;
  search.found = {distance, at, material, placed ? instance->object : mesh.objects[args->primID]};
  return true;
}

}  // namespace

std::optional<NearSurface> RayCaster::nearest(const Eigen::Vector3f& point, float reach,
                                              const std::vector<bool>& ignored) const {
  const Scene& s = *scene_;
  RTCPointQuery query{point.x(), point.y(), point.z(), 0, reach};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search search{&s.world->mesh, s.placed, 1, point, &ignored, {}};
  bool found = rtcPointQuery(s.still, &query, &context, consider, &search);
  if (!s.movers.empty()) {
    rtcInitPointQueryContext(&context);
    search.instances = s.movers;
    search.first_instance = 0;
    found = rtcPointQuery(s.moving, &query, &context, consider, &search) || found;
  }
  if (!found) return std::nullopt;
  return search.found;
}

}  // namespace saker::simulation
