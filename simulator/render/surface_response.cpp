#include "simulator/render/surface_response.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/render/ggx.hpp"

namespace traygauge {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kMinAlpha = 0.01F;  // below, a highlight is sharper than any picture of it
constexpr float kMinCosine = 1e-4F;
constexpr float kMinEntry = 1e-3F;  // of light under a coat

}  // namespace

SurfaceResponse::SurfaceResponse(const Reflectance& reflectance, const Eigen::Vector3f& normal,
                                 const Eigen::Vector3f& to_viewer)
    : normal_(normal),
      to_viewer_(to_viewer),
      base_(Eigen::Vector3f::Zero()),
      mirror_(Eigen::Vector3f::Zero()),
      is_metal_(reflectance.is_metal),
      alpha_(std::clamp(reflectance.roughness, kMinAlpha, 1.0F)),
      viewer_cosine_(std::max(normal.dot(to_viewer), kMinCosine)),
      viewer_seen_(ggx::seen(viewer_cosine_, alpha_)),
      coat_(std::clamp(reflectance.coat, 0.0F, 1.0F), alpha_) {
  const Eigen::Vector3f base = reflectance.base.cwiseMax(0.0F).cwiseMin(1.0F);
  if (reflectance.is_metal) {
    mirror_ = base;
    return;
  }
  base_ = base;
  if (!(reflectance.coat > 0.0F)) return;
  mirror_.setConstant(std::min(reflectance.coat, 1.0F));
  to_viewer_fraction_ = 1.0F - coat_.at(viewer_cosine_);
}

Eigen::Vector3f SurfaceResponse::fresnel(float cosine) const {
  const float rest = std::clamp(1.0F - cosine, 0.0F, 1.0F);
  const float rest2 = rest * rest;
  return mirror_ + (Eigen::Vector3f::Ones() - mirror_) * (rest2 * rest2 * rest);
}

float SurfaceResponse::base_entry(const Eigen::Vector3f& to_light) const {
  const float cosine = normal_.dot(to_light);
  if (cosine <= 0.0F) return 0.0F;
  if (!has_coat()) return 1.0F;
  return (1.0F - coat_.at(cosine)) / std::max(1.0F - coat_.mean(), kMinEntry);
}

Eigen::Vector3f SurfaceResponse::base_factor(const Eigen::Vector3f& to_light) const {
  const float cosine = std::max(normal_.dot(to_light), 0.0F);
  return base_albedo() * (base_entry(to_light) * cosine / kPi);
}

// Of a direction whose half vector has this cosine to the normal.
float SurfaceResponse::density_of(float half_cosine) const {
  return ggx::distribution(half_cosine, alpha_) * viewer_seen_ / (4.0F * viewer_cosine_);
}

SurfaceResponse::CoatFactor SurfaceResponse::coat_factor(const Eigen::Vector3f& to_light) const {
  const float light_cosine = normal_.dot(to_light);
  if (light_cosine <= 0.0F) return {};
  const Eigen::Vector3f half = (to_light + to_viewer_).normalized();
  const float density = density_of(normal_.dot(half));
  const float seen_too = ggx::seen_both_ways(viewer_cosine_, light_cosine, alpha_) / viewer_seen_;
  return {fresnel(half.dot(to_light)) * (density * seen_too), density};
}

std::optional<SurfaceResponse::CoatSample> SurfaceResponse::sample_coat(const Eigen::Vector2f& place) const {
  const Eigen::Matrix3f frame = ggx::frame_about(normal_);
  Eigen::Vector3f viewer = frame.transpose() * to_viewer_;
  viewer.z() = viewer_cosine_;
  const Eigen::Vector3f local_half = ggx::visible_normal(viewer, alpha_, place);
  const Eigen::Vector3f half = frame * local_half;
  const float half_cosine = half.dot(to_viewer_);
  CoatSample sample;
  sample.to_light = 2.0F * half_cosine * half - to_viewer_;
  const float light_cosine = normal_.dot(sample.to_light);
  if (light_cosine <= 0.0F) return std::nullopt;
  sample.weight =
      fresnel(half_cosine) * (ggx::seen_both_ways(viewer_cosine_, light_cosine, alpha_) / viewer_seen_);
  sample.density = density_of(local_half.z());
  return sample;
}

Eigen::Vector3f cosine_direction(const Eigen::Vector3f& axis, const Eigen::Vector2f& place) {
  const float radius = std::sqrt(place.x());
  const float angle = 2.0F * kPi * place.y();
  const Eigen::Vector3f local(radius * std::cos(angle), radius * std::sin(angle),
                              std::sqrt(1.0F - place.x()));
  return ggx::frame_about(axis) * local;
}

}  // namespace traygauge
