// Scans as the API writes them.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "firmware/base/expected.hpp"
#include "firmware/hub/hub_store.hpp"
#include "firmware/web/http_message.hpp"

namespace traygauge {

// A scan with its corrections applied; the measured volumes stand beside the corrected ones.
Expected<nlohmann::ordered_json> scan_answer(Store& store, const StoredScan& scan);

HttpResponse answer_scan(Store& store, const StoredScan& scan, int status = 200);

// What `use` answers from the scan that {id} in the path names; 404 where there is none.
HttpResponse with_scan(HubStore& hub, const HttpRequest& request,
                       const std::function<HttpResponse(Store&, const StoredScan&)>& use);

// Null for an empty text.
nlohmann::ordered_json text_or_null(const std::string& text);

// In one line; what is not UTF-8 is replaced.
HttpResponse json_answer(const nlohmann::ordered_json& json, int status = 200);

// 503 with the store's failure.
HttpResponse store_failure(const std::string& text);
// 400 about a parameter or a key.
HttpResponse wrong_request(const std::string& text);

}  // namespace traygauge
