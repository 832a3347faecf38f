# Writes OUTPUT, a source with the commit that ROOT is at (firmware/built_commit.hpp): cmake -DROOT=… -DOUTPUT=… [-DCOMMIT=…] -P commit.cmake
# COMMIT counts where git does not know: a source archive, or a checkout whose history is elsewhere. The file is touched only
# where it changes.
if(NOT COMMIT AND EXISTS ${ROOT}/.git)
  find_program(git git)
  if(git)
    # As whoever builds: a checkout of another user's is no less known.
    execute_process(COMMAND ${git} -c safe.directory=* -C ${ROOT} describe --always --exclude=* --abbrev=12 --dirty=+changes
      OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
if(NOT COMMIT MATCHES "^[0-9a-f]+([+]changes)?$")
  set(COMMIT "")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "firmware/built_commit.hpp"

namespace traygauge {

const char* const kCommit = "@COMMIT@";

}  // namespace traygauge
]])
