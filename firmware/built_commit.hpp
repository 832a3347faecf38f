// The commit that this was built from; empty: not known. cmake/commit.cmake writes the source at each build.
#pragma once

namespace traygauge {

extern const char* const kCommit;

}  // namespace traygauge
