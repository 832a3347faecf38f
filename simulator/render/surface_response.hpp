// How a point of a surface sends light to a viewer.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "simulator/render/coat_albedo.hpp"
#include "simulator/render/material.hpp"

namespace traygauge {

// Two ways for any direction to the light. The base: diffuse, under what its coat lets in and out. The coat,
// or metal: a rough mirror, GGX with Smith's heights (Walter 2007, Heitz 2014) and Schlick's Fresnel term.
// What the coat mirrors, the base loses, so that a white base under a coat returns all light.
class SurfaceResponse {
 public:
  // Both of unit length, on the same side of the surface.
  SurfaceResponse(const Reflectance& reflectance, const Eigen::Vector3f& normal,
                  const Eigen::Vector3f& to_viewer);

  // With a response from the base, from the coat at all.
  bool has_base() const { return base_.maxCoeff() > 0.0F; }
  bool has_coat() const { return mirror_.maxCoeff() > 0.0F; }

  bool is_metal() const { return is_metal_; }
  // Whether lights show in it by their shape.
  bool is_sharp() const { return is_metal_ || alpha_ < kSharpAlpha; }
  // Of the rays that meet it, the share that is followed on into the mirror: half where the mirror is little
  // of what the viewer sees. Its brightest, the lights, are drawn by their own places as well.
  float mirrored_fraction() const { return is_metal_ || to_viewer_fraction_ < kMostlyBase ? 1.0F : 0.5F; }

  // Share of evenly arriving light that the base returns.
  Eigen::Vector3f base_albedo() const { return to_viewer_fraction_ * base_; }
  // The share of light from a direction that reaches the base, over its mean. Times base_albedo / π: the
  // base's response.
  float base_entry(const Eigen::Vector3f& to_light) const;

  // Radiance to the viewer by irradiance from the light: response times the cosine at the light.
  Eigen::Vector3f base_factor(const Eigen::Vector3f& to_light) const;
  struct CoatFactor {
    Eigen::Vector3f factor = Eigen::Vector3f::Zero();
    float density = 0.0F;  // how often sample_coat draws that direction, per steradian
  };
  CoatFactor coat_factor(const Eigen::Vector3f& to_light) const;

  struct CoatSample {
    Eigen::Vector3f to_light = Eigen::Vector3f::UnitZ();
    Eigen::Vector3f weight = Eigen::Vector3f::Zero();  // its factor over its density
    float density = 0.0F;
  };
  // By the visible normals (Heitz 2018); `place` in [0, 1)². Nothing when the mirrored direction enters the
  // surface.
  std::optional<CoatSample> sample_coat(const Eigen::Vector2f& place) const;

 private:
  static constexpr float kSharpAlpha = 0.3F;
  static constexpr float kMostlyBase = 0.9F;

  Eigen::Vector3f fresnel(float cosine) const;
  float density_of(float half_cosine) const;

  Eigen::Vector3f normal_, to_viewer_;
  Eigen::Vector3f base_;    // diffuse; black for metal
  Eigen::Vector3f mirror_;  // mirrored at normal incidence; black without coat
  bool is_metal_;
  float alpha_;
  float viewer_cosine_;
  float viewer_seen_;                // share of the small mirrors that the viewer sees
  float to_viewer_fraction_ = 1.0F;  // of what the base sends to the viewer passes the coat
  CoatAlbedo coat_;                  // of the coat over a base
};

// Unit directions about an axis.
Eigen::Vector3f cosine_direction(const Eigen::Vector3f& axis, const Eigen::Vector2f& place);

}  // namespace traygauge
