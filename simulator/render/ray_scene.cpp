#include "simulator/render/ray_scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "simulator/render/embree.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kHitPacket = 8;
constexpr std::size_t kShadowPacket = 8;
constexpr std::size_t kWideShadowPacket = 16;

// A point on a triangle is off by a few units in the last place of its largest coordinate; this is 16.
constexpr float kLeaveShare = 16.0F * 0x1p-23F;
constexpr float kMinNormal = 1e-6F;     // of three that cancel out
constexpr float kLeaveFrom_mm = 50.0F;  // coordinates below this count as this: the ray's own arithmetic

void check_mesh(const SceneObject& object, std::size_t index) {
  const std::string name = "scene: object " + std::to_string(index);
  const TriangleMesh& mesh = object.mesh;
  if (object.material == nullptr) throw std::invalid_argument(name + " has no material");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.vertices.size()) {
    throw std::invalid_argument(name + " has " + std::to_string(mesh.normals.size()) + " normals for " +
                                std::to_string(mesh.vertices.size()) + " vertices");
  }
  for (const auto& triangle : mesh.triangles) {
    if (std::ranges::max(triangle) >= mesh.vertices.size()) {
      throw std::invalid_argument(name + " has a triangle with a vertex that does not exist");
    }
  }
}

RTCGeometry make_geometry(RTCDevice device, const TriangleMesh& mesh) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Eigen::Vector3f), mesh.vertices.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), mesh.triangles.size());
  if (vertices != nullptr && triangles != nullptr) {
    auto* coordinates = static_cast<float*>(vertices);
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      coordinates = std::copy_n(vertex.data(), 3, coordinates);
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(std::uint32_t));
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

struct Corner {
  const Eigen::Vector3f& vertex_mm;
  const Eigen::Vector3f& normal;
  float weight;
};

// The interpolated normal and, seen from outside, the point lifted to the corners' tangent planes, so that
// facets at the edge of light do not hide from it (Hanika 2021, Hacking the shadow terminator).
void round_off(std::span<const Corner, 3> corners, bool is_behind, SurfaceHit& hit) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::Vector3f lift_mm = Eigen::Vector3f::Zero();
  for (const auto& [vertex_mm, normal, weight] : corners) {
    mean += weight * normal;
    const float below_mm = std::max(normal.dot(vertex_mm - hit.point_mm), 0.0F);
    lift_mm += (weight * below_mm) * normal;
  }
  const float length = mean.norm();
  if (length < kMinNormal) return;
  hit.normal = mean / length;
  if (is_behind) return;
  hit.is_smooth = true;
  hit.smooth_point_mm += lift_mm;
}

template <class Packet>
void put_ray(Packet& packet, std::size_t i, const Ray& ray) {
  packet.org_x[i] = ray.origin_mm.x();
  packet.org_y[i] = ray.origin_mm.y();
  packet.org_z[i] = ray.origin_mm.z();
  packet.dir_x[i] = ray.direction.x();
  packet.dir_y[i] = ray.direction.y();
  packet.dir_z[i] = ray.direction.z();
  packet.tnear[i] = 0.0F;
  packet.tfar[i] = ray.end;
  packet.time[i] = 0.0F;
  packet.mask[i] = ~0U;
  packet.id[i] = 0U;
  packet.flags[i] = 0U;
}

// Up to kLanes rays; the others of the packet are not looked at.
template <std::size_t kLanes, class Packet, class Trace>
void occlude_packet(std::span<const Ray> rays, std::span<std::uint8_t> is_occluded, const Trace& trace) {
  alignas(64) std::array<int, kLanes> valid{};
  Packet packet;
  for (std::size_t i = 0; i < kLanes; ++i) {
    valid[i] = i < rays.size() ? -1 : 0;
    put_ray(packet, i, rays[std::min(i, rays.size() - 1)]);
  }
  trace(valid.data(), packet);
  for (std::size_t i = 0; i < rays.size(); ++i) is_occluded[i] = packet.tfar[i] < 0.0F ? 1 : 0;
}

}  // namespace

struct RayScene::Handles {
  Handles() : device(rtcNewDevice(nullptr)), scene(device == nullptr ? nullptr : rtcNewScene(device)) {}
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void check() const {
    const RTCError error = rtcGetDeviceError(device);
    if (device == nullptr || error != RTC_ERROR_NONE) {
      throw std::runtime_error("Embree failed with error " + std::to_string(static_cast<int>(error)) +
                               (error == RTC_ERROR_OUT_OF_MEMORY ? ": out of memory" : ""));
    }
  }

  RTCDevice device;
  RTCScene scene;
};

RayScene::RayScene(const Scene& scene, ObjectChoice choice)
    : scene_(scene), handles_(std::make_unique<Handles>()) {
  handles_->check();
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    check_mesh(object, i);
    if (object.mesh.triangles.empty() || object.is_clear != (choice == ObjectChoice::clear)) continue;
    is_empty_ = false;
    RTCGeometry geometry = make_geometry(handles_->device, object.mesh);
    rtcAttachGeometryByID(handles_->scene, geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(handles_->scene);
  handles_->check();
}

RayScene::~RayScene() = default;

// From the barycentric coordinates, which place the point more exactly than the distance along the ray does.
SurfaceHit RayScene::hit_of(const Ray& ray, unsigned geometry, unsigned triangle, float u, float v,
                            float distance) const {
  SurfaceHit hit;
  hit.object = &scene_.objects[geometry];
  const TriangleMesh& mesh = hit.object->mesh;
  const auto [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3f& p = mesh.vertices[a];
  const Eigen::Vector3f to_b = mesh.vertices[b] - p;
  const Eigen::Vector3f to_c = mesh.vertices[c] - p;
  hit.distance = distance;
  hit.point_mm = p + u * to_b + v * to_c;
  hit.flat_normal = to_b.cross(to_c).normalized();
  hit.normal = hit.flat_normal;
  hit.smooth_point_mm = hit.point_mm;
  const bool is_behind = hit.flat_normal.dot(ray.direction) > 0.0F;
  if (!mesh.normals.empty()) {
    const Corner corners[] = {{p, mesh.normals[a], 1.0F - u - v},
                              {mesh.vertices[b], mesh.normals[b], u},
                              {mesh.vertices[c], mesh.normals[c], v}};
    round_off(corners, is_behind, hit);
  }
  if (is_behind) {
    hit.flat_normal = -hit.flat_normal;
    hit.normal = -hit.normal;
  }
  // An interpolated normal may turn away from the viewer at a silhouette.
  if (hit.normal.dot(ray.direction) >= 0.0F) hit.normal = hit.flat_normal;
  return hit;
}

void RayScene::intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits, RayBundle bundle) const {
  embree::Query query(bundle == RayBundle::coherent);
  for (std::size_t first = 0; first < rays.size(); first += kHitPacket) {
    const std::size_t count = std::min(kHitPacket, rays.size() - first);
    alignas(32) std::array<int, kHitPacket> valid{};
    RTCRayHit8 packet;
    for (std::size_t i = 0; i < kHitPacket; ++i) {
      valid[i] = i < count ? -1 : 0;
      put_ray(packet.ray, i, rays[first + std::min(i, count - 1)]);
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    query.intersect(valid.data(), handles_->scene, packet);
    for (std::size_t i = 0; i < count; ++i) {
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        hits[first + i] = {};
        continue;
      }
      hits[first + i] = hit_of(rays[first + i], packet.hit.geomID[i], packet.hit.primID[i], packet.hit.u[i],
                               packet.hit.v[i], packet.ray.tfar[i]);
    }
  }
}

void RayScene::occlude(std::span<const Ray> rays, std::span<std::uint8_t> is_occluded,
                       RayBundle bundle) const {
  embree::Query query(bundle == RayBundle::coherent);
  while (rays.size() > kShadowPacket) {
    const std::size_t count = std::min(kWideShadowPacket, rays.size());
    const auto trace = [&](const int* valid, RTCRay16& packet) {
      query.occluded(valid, handles_->scene, packet);
    };
    occlude_packet<kWideShadowPacket, RTCRay16>(rays.first(count), is_occluded, trace);
    rays = rays.subspan(count);
    is_occluded = is_occluded.subspan(count);
  }
  if (rays.empty()) return;
  const auto trace = [&](const int* valid, RTCRay8& packet) {
    query.occluded(valid, handles_->scene, packet);
  };
  occlude_packet<kShadowPacket, RTCRay8>(rays, is_occluded, trace);
}

bool RayScene::is_above(const SurfaceHit& hit, const Eigen::Vector3f& direction) {
  return hit.normal.dot(direction) > 0.0F && (hit.is_smooth || hit.flat_normal.dot(direction) > 0.0F);
}

Eigen::Vector3f RayScene::leave(const SurfaceHit& hit, const Eigen::Vector3f& direction) {
  const float size_mm = std::max(hit.point_mm.cwiseAbs().maxCoeff(), kLeaveFrom_mm);
  const float side = hit.normal.dot(direction) < 0.0F ? -1.0F : 1.0F;
  return hit.smooth_point_mm + (side * kLeaveShare * size_mm) * hit.flat_normal;
}

}  // namespace traygauge
