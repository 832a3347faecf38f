// Embree 3 (Debian 12) and 4 (Debian 13) in one interface: packets of rays against a scene.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace traygauge::embree {

// How the rays of a packet run: coherent ones beside each other.
#if RTC_VERSION_MAJOR >= 4
class Query {
 public:
  explicit Query(bool is_coherent) {
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags =
        is_coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  void intersect(const int* valid, RTCScene scene, RTCRayHit8& packet) {
    rtcIntersect8(valid, scene, &packet, &intersect_);
  }
  void occluded(const int* valid, RTCScene scene, RTCRay8& packet) {
    rtcOccluded8(valid, scene, &packet, &occluded_);
  }
  void occluded(const int* valid, RTCScene scene, RTCRay16& packet) {
    rtcOccluded16(valid, scene, &packet, &occluded_);
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};
#else
class Query {
 public:
  explicit Query(bool is_coherent) {
    rtcInitIntersectContext(&context_);
    context_.flags =
        is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void intersect(const int* valid, RTCScene scene, RTCRayHit8& packet) {
    rtcIntersect8(valid, scene, &context_, &packet);
  }
  void occluded(const int* valid, RTCScene scene, RTCRay8& packet) {
    rtcOccluded8(valid, scene, &context_, &packet);
  }
  void occluded(const int* valid, RTCScene scene, RTCRay16& packet) {
    rtcOccluded16(valid, scene, &context_, &packet);
  }

 private:
  RTCIntersectContext context_;
};
#endif

}  // namespace traygauge::embree
