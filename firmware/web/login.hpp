// Logging in, for browsers, which cannot set headers where they listen to events.
#pragma once

#include "firmware/web/access.hpp"
#include "firmware/web/router.hpp"

namespace traygauge {

// POST /api/v1/login {"token"} answers {"role","name"} and sets a cookie that holds the token: of view for 30
// days, of manage until the browser is closed, of kiosk for 400 days, the most that browsers keep one. GET
// /api/v1/session answers {"role","name"}, and renews a kiosk's cookie. POST /api/v1/logout removes the
// cookie. The cookie has no Path: a browser then takes the folder of the address, /api/v1 under whatever a
// proxy puts before it.
void add_login_routes(Router& router, Access& access);

}  // namespace traygauge
