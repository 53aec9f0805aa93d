// NumPy's files of arrays, .npy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/compute/type.hpp"

namespace eyeray::engine::compute {

// An array in a .npy file: its data type as NumPy writes it, without white space, such as '<f4' or
// [('position','<f4',(3,)),('id','<u4')]; its shape; and the elements' bytes in C order.
struct NpyArray {
  std::string descr;
  std::vector<uint64_t> shape;
  std::string_view bytes;
};

// The array of a file with these bytes, which must live as long. Error (file_io), with `name`, if the file is
// damaged, has Fortran's order, or another byte order than little-endian.
NpyArray parse_npy(std::string_view file, const std::string& name);
std::string write_npy(const NpyArray& array);

// The data type and shape of a value of the type. A block of one member is that member.
NpyArray npy_form(const Type& type);

}  // namespace eyeray::engine::compute
