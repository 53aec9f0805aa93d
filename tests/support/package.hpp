// Makes packages in ZIP form, for tests of 3MF files.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace eyeray::engine::test {

using PackageParts = std::vector<std::pair<std::string, std::string>>;  // names and contents

// The content as raw Deflate.
inline std::string deflated(const std::string& content) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, uLong(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = uInt(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// A ZIP archive. `flags`: those of all its parts.
inline std::string zip_of(const PackageParts& parts, bool compressed = false, unsigned flags = 0) {
  std::string file, directory;
  const auto number = [](uint64_t value, int size) {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += char(value >> (8 * i));
    return bytes;
  };
  for (const auto& [name, content] : parts) {
    const std::string packed = compressed ? deflated(content) : content;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), uInt(content.size()));
    // Version, flags, method, time, date, checksum, sizes, and the lengths of the name and of more fields.
    const std::string common = number(20, 2) + number(flags, 2) + number(compressed ? 8 : 0, 2) +
                               number(0, 4) + number(sum, 4) + number(packed.size(), 4) +
                               number(content.size(), 4) + number(name.size(), 2) + number(0, 2);
    directory += number(0x02014b50, 4) + number(20, 2) + common + std::string(10, '\0') +
                 number(file.size(), 4) + name;
    file += number(0x04034b50, 4) + common + name + packed;
  }
  const std::string counts = number(parts.size(), 2) + number(parts.size(), 2);
  return file + directory + number(0x06054b50, 4) + number(0, 4) + counts + number(directory.size(), 4) +
         number(file.size(), 4) + number(0, 2);
}

// A 3MF file with a model part and perhaps others.
inline std::string package_3mf(const std::string& model, const PackageParts& others = {},
                               bool compressed = false) {
  PackageParts parts = {
      {"_rels/.rels",
       "<?xml version=\"1.0\"?><Relationships "
       "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r\" "
       "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
       "Target=\"/3D/3dmodel.model\"/></Relationships>"},
      {"3D/3dmodel.model", model}};
  parts.insert(parts.end(), others.begin(), others.end());
  return zip_of(parts, compressed);
}

// A model part with such content. The prefixes of the extensions are m and p.
inline std::string model_3mf(const std::string& resources, const std::string& build,
                             const std::string& unit = "millimeter") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"" + unit +
         "\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
         "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
         "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
         "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\">\n<resources>\n" +
         resources + "</resources>\n<build>\n" + build + "</build>\n</model>\n";
}

// The vertices of the unit square, and its two triangles with these attributes.
inline std::string square_3mf(const std::string& first = "", const std::string& second = "",
                              const std::string& more = "") {
  return "<mesh><vertices>\n<vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
         "<vertex x=\"1\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"+1e0\" z=\"0\"/>\n</vertices><triangles>\n"
         "<triangle v1=\"0\" v2=\"1\" v3=\"2\" " +
         first + "/>\n<triangle v1=\"0\" v2=\"2\" v3=\"3\" " + second + "/>\n</triangles>" + more + "</mesh>";
}

}  // namespace eyeray::engine::test
