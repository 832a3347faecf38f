#include "firmware/check/view_check.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

bool sees_card(SetupSite& site, Camera& camera, const LensConfig& lens, const CardDescription& card) {
  const Picture pattern = load_pattern(card);
  TakenPicture picture;
  const CheckResult taken = check_camera(camera, picture);
  std::optional<Pose> camera_from_table;
  const CheckResult result = taken.is_good ? check_card(picture.frame.view, lens_of(lens.camera),
                                                        card_of(card, pattern), camera_from_table)
                                           : taken;
  camera.stop();
  return tell(site, result);
}

bool all_see_card(SetupSite& site) {
  const StationFile station = site.read();
  require_geometry(station);
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(station);
  const StationDevices devices = opened->devices();
  bool all_see = sees_card(site, devices.camera, *station.lens, *station.card);
  if (devices.second_camera != nullptr)
    all_see = sees_card(site, *devices.second_camera, *station.second_lens, *station.card) && all_see;
  return all_see;
}

}  // namespace

bool set_up_view(SetupSite& site) {
  return try_until_done(site, [&site] {
    static_cast<void>(
        site.dialogue.ask("Lay the card on the tray, where it will lie beside the dishes, and press Enter"));
    return all_see_card(site);
  });
}

}  // namespace traygauge
