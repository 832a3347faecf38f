# Writes OUTPUT, a header with the hashes of what results are computed with (lists of files in CORE, FIRMWARE,
# SIMULATOR, METHODS): results of another program are not taken for those of this one.
cmake_policy(VERSION 3.25)

function(hash_files result)
  set(hashes "")
  foreach(file IN LISTS ARGN)
    file(SHA256 "${file}" hash)
    string(APPEND hashes "${hash}\n")
  endforeach()
  string(SHA256 all "${hashes}")
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

hash_files(core ${CORE})
hash_files(firmware ${FIRMWARE})
hash_files(simulator ${SIMULATOR})
hash_files(methods ${METHODS})
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// Which program results were computed with.
#pragma once

namespace traygauge::tables {

inline constexpr const char* kCoreFingerprint = \"@core@\";
inline constexpr const char* kFirmwareFingerprint = \"@firmware@\";
inline constexpr const char* kSimulatorFingerprint = \"@simulator@\";
inline constexpr const char* kMethodsFingerprint = \"@methods@\";

}  // namespace traygauge::tables
" @ONLY)
