// What people choose on the command line, read alike by every command that measures.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "firmware/segment/label_source.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

class Command;

// The pair that `typed` ("A,B") names; without it the first of the capture's, else 0 and 1.
std::array<int, 2> choose_pair(const std::string& typed, const Capture& capture);

// Throws InputError unless both views have label pictures.
void require_labels(const Capture& capture, const std::array<int, 2>& pair);

// What `typed` names: given or auto; empty: auto where neither view has a label picture, else given.
// UsageError for anything else, InputError for labels that are to be given and are not.
LabelSource choose_labels(const std::string& typed, const Capture& capture, const std::array<int, 2>& pair);

// "--items N": how many items there are, for labels that are found.
void add_items_option(Command& command, int& items);

// UsageError where so many items are said to lie in given outlines; 0: nothing is said.
void check_hint(int items, LabelSource labels);

// UsageError unless `typed` is given, auto or empty.
void check_label_source(const std::string& typed);

// Whether a result could be stored at all is known before the work is done: OutputError; empty: nothing to
// store.
void check_output(const std::string& file);

// A whole number from 0 to 2^64 - 1.
std::uint64_t parse_seed(const std::string& typed);

}  // namespace traygauge
