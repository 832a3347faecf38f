// Do both pictures show an item alike where its surface lies? A hand, dirt on the lens or steam in one place
// of a picture hides food there.
#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/table_frame.hpp"
#include "core/pipeline/picture_agreement_params.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

// Share, 0 to 1, of an item's samples whose colour differs between the pictures, once each colour's median
// ratio, of light and shade, is taken out; the larger of both grids. 0 where too little can be compared.
double unlike_share(std::uint8_t item, const std::array<SurfaceGrid, 2>& grids, const ViewPair& views,
                    const TableCameras& camera_from_table, const PictureAgreementParams& params);

}  // namespace traygauge
