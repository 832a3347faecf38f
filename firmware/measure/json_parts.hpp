// What the documents of `measure` and `station` have in common.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "firmware/measure/measure_report.hpp"

namespace traygauge {

// Of both documents. 2: warnings are objects; 1 had texts.
inline constexpr int kMeasureVersion = 2;

// Numbers of an item that was not measured are null.
nlohmann::ordered_json item_document(const ItemResult& item);

// [{"name","label","value","sigma","limit","verdict"}, …]; label is that of the dish or item.
nlohmann::ordered_json check_documents(const CheckList& checks);

// [first, second]: how blurred each picture is, in pixels; null where its card shows too few edges.
nlohmann::ordered_json blur_document(const PictureReport& pictures);

// [{"code","message","label"}, …]; label is null where the doubt is about the whole pair.
nlohmann::ordered_json warning_documents(const std::vector<ReportedWarning>& warnings);

}  // namespace traygauge
