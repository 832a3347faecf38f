// Whether a text is well-formed XML, as far as it uses elements, attributes, text and the five named
// entities.
#pragma once

#include <string>

namespace traygauge {

// What is wrong with it; empty: nothing.
std::string find_xml_fault(const std::string& document);

}  // namespace traygauge
