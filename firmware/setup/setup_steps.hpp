// The steps of `traygauge setup`, in their order. Each says what it wants, tries it, and on failure what is
// wrong and what to do. True when the step is done, false where the person left it out. They throw
// DialogueEnded where the person ends, InputError and OutputError where files are not as expected.
#pragma once

#include "firmware/setup/setup_site.hpp"

namespace traygauge {

bool set_up_camera(SetupSite& site);  // which one, and how bright its picture is
bool set_up_button(SetupSite& site);  // button and lamp
bool set_up_card(SetupSite& site);    // print, measure; [card]
bool set_up_lens(SetupSite& site);    // [lens], [second_lens], by a chessboard
bool set_up_view(SetupSite& site);    // the card in the camera's picture
bool set_up_arm(SetupSite& site);     // [arm_geometry]
bool set_up_dishes(SetupSite& site);  // [trays] dishes; learns new ones
bool set_up_hub(SetupSite& site);     // [station], [hub]
bool measure_first_tray(SetupSite& site);

}  // namespace traygauge
