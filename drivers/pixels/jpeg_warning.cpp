#include "drivers/pixels/jpeg_warning.hpp"

#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
// jpeglib.h relies on the two above.
#include <jpeglib.h>
// and this on the one before.
#include <jerror.h>

namespace traygauge {

JpegWarning judge_jpeg_warning(const jpeg_error_mgr& errors) {
  constexpr int few = 16;  // many are left over where others are missing
  if (errors.msg_code == JWRN_EXTRANEOUS_DATA && errors.msg_parm.i[0] <= few) {
    return JpegWarning::few_bytes_too_many;
  }
  return errors.msg_code == JWRN_JPEG_EOF ? JpegWarning::end_missing : JpegWarning::damage;
}

}  // namespace traygauge
