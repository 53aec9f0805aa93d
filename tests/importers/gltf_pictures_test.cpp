// Errors and warnings for glTF whose pictures or containers break a rule of its specification.
#include <cstring>

#include "gltf_rich_file.hpp"
#include "host/image/coded_image.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

TEST_CASE("rules of glTF: samplers, and pictures without uv") {
  GltfFile file = rich_file();
  std::ifstream png("tests/image/pictures/rgb.png", std::ios::binary);
  const std::string picture{std::istreambuf_iterator<char>(png), {}};
  file.json["images"] = {{{"uri", "data:image/png;base64," + base64(picture)}}};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  file.json["samplers"] = {{{"wrapS", 10497}, {"magFilter", 9729}}};
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  CHECK(message_of(file) == "");
  file.json["samplers"][0]["wrapS"] = 5;
  CHECK(message_of(file) == "a.gltf: error: samplers[0] has a wrapS that glTF does not define");
  file.json["samplers"][0] = {{"magFilter", 1}};
  CHECK(message_of(file) == "a.gltf: error: samplers[0] has a magFilter that glTF does not define");
  file.json["samplers"][0] = {{"minFilter", 9988}};
  CHECK(message_of(file) == "a.gltf: error: samplers[0] has a minFilter that glTF does not define");
  file.json["samplers"][0] = {{"minFilter", 9987}};
  CHECK(message_of(file) == "");
  file.json["samplers"][0] = Json::object();
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  CHECK(message_of(file) ==
        "meshes without the uv that their material's picture needs: 1, the first meshes[0].primitives[0]");

  // A picture whose type is not the one that it states, and a picture that names two sources.
  Json& image = file.json["images"][0];
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 0;
  image["mimeType"] = "image/jpeg";
  CHECK(message_of(file) ==
        "pictures of another type than their mimeType, decoded by their content: 1, the first images[0]");
  const Json as_it_was = image;
  const std::string tga =
      std::string(2, '\0') + "\2" + std::string(9, '\0') + std::string("\1\0\1\0\30\0abc", 9);
  image = {{"uri", "data:image/x-tga;base64," + base64(tga)}};
  CHECK(message_of(file) ==
        "pictures that are none of PNG, JPEG and WebP, decoded by their content: 1, the first images[0]");
  image = as_it_was;
  image["mimeType"] = "image/gif";
  CHECK(message_of(file) ==
        "pictures of another type than their mimeType, decoded by their content: 1, the first images[0]");
  GltfFile in_view = file;
  in_view.json["images"][0] = {{"bufferView", in_view.add_view(picture)}};
  in_view.json["bufferViews"].back()["byteStride"] = 4;
  CHECK(message_of(in_view) ==
        "pictures in views with a byteStride, which is ignored: 1, the first images[0]; pictures in views "
        "without a mimeType, decoded by their content: 1, the first images[0]");
  image["bufferView"] = 0;
  CHECK(
      message_of(file) ==
      "a picture was left out: a.gltf: error: images[0] has both a uri and a bufferView: it is one picture; "
      "pictures with both or neither of uri and bufferView: 1, the first images[0]");
  image = {{"uri", image["uri"]}};

  // The pixels of the picture count among those of all images of the scene.
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 0;
  PixelBudget few{5};
  CHECK_THROWS_WITH_AS(import_bytes(file.gltf(), "a.gltf", {}, &few),
                       "a.gltf: error: cannot read images[0]: it has 3×2 pixels; of the 2^28 that all images "
                       "of a scene may have together, 5 are left",
                       InputError);
}

TEST_CASE("rules of glTF: containers and buffers") {
  const std::string glb = rich_file().glb();
  const auto warnings_of = [](const std::string& bytes) {
    const ImportedScene scene = import_sound(bytes, "a.glb");
    return scene.warnings.empty() ? "" : scene.warnings[0];
  };
  CHECK(warnings_of(glb) == "");
  CHECK(warnings_of(glb + "1234") == "lengths of .glb that are not the file's: 1, the first the file");
  std::string twice = glb + glb.substr(12);
  const uint32_t length = uint32_t(twice.size());
  std::memcpy(twice.data() + 8, &length, 4);
  CHECK(warnings_of(twice) == "second chunks of a type in .glb, left out: 1, the first the file");

  GltfFile file = rich_file();
  const std::string data = "data:application/octet-stream;base64," + base64(file.data() + "more");
  CHECK(warnings_of(file.gltf(data)) ==
        "buffers with more data than their byteLength, left out: 1, the first buffers[0]");
}
