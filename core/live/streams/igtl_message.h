#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>

namespace capstan::live {

/// Message TRANSFORM of the OpenIGTLink protocol, version 1, as 3D Slicer reads it: a header of 58 bytes
/// (version, type, device, time, size and CRC-64 of the body), then the rotation column by column and the
/// translation [mm] as 12 numbers of single precision; all big-endian.
/// http://openigtlink.org/protocols/v2_header.html and v2_transform.html.
/// `device`: name of the transform in the receiver, at most 20 bytes. `pose`: translation in m. `time`: since
/// 1970 [s].
std::string igtlTransform(std::string_view device, const Eigen::Isometry3d& pose, double time);

/// CRC-64 of OpenIGTLink: polynomial of ECMA-182, 0x42F0E1EBA9EA3693, most significant bit first, from 0.
std::uint64_t igtlChecksum(std::string_view bytes);

}  // namespace capstan::live
