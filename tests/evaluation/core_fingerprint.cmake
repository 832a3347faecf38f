# Writes OUTPUT, a header with the hash of ARCHIVE: results of another core are not taken for those of this one.
file(SHA256 "${ARCHIVE}" hash)
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// Which core library results were computed with.
#pragma once

namespace traygauge::tables {

inline constexpr const char* kCoreFingerprint = \"@hash@\";

}  // namespace traygauge::tables
" @ONLY)
