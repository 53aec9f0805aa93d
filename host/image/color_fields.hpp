// The ignored fields of a PNG's, a JPEG's or a WebP's header that define the meaning of its codes and pixels.
// Codes are always taken as sRGB, pixels as squares.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::image {

// A clause for each field with another meaning than that, such as "its gamma (gAMA) of 1 is ignored: …".
// Fields that cannot be read count as absent. Sources: PNG Specification, Third Edition, 2025, 11.3 and 4.3
// (cICP before iCCP before sRGB before gAMA and cHRM); ICC.1:2022, Annex B.4 (profiles in JPEG);
// Google: WebP Container Specification.
std::vector<std::string> png_color_fields(std::string_view bytes);
std::vector<std::string> jpeg_color_fields(std::string_view bytes);
std::vector<std::string> webp_color_fields(std::string_view bytes);
// The clause for an ICC profile, of a JPEG or a TIFF; "" if it is sRGB's, or empty.
std::string profile_clause(std::string_view profile);

}  // namespace eyeray::engine::image
