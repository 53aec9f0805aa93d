// Errors and warnings for glTF that breaks a rule of its specification, if that can change the picture: one
// row for each rule.
#include "gltf_rich_file.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

std::function<void(GltfFile&)> sparse(const std::vector<double>& indices, const Json& count) {
  return [=](GltfFile& file) {
    file.json["accessors"][positions]["sparse"] = {
        {"count", count},
        {"indices", {{"bufferView", file.add_view(indices, 5121)}, {"componentType", 5121}}},
        {"values", {{"bufferView", file.add_view(std::vector<double>(3 * indices.size(), 0.25), 5126)}}}};
  };
}
std::vector<double> with(std::vector<double> numbers, size_t at, double value) {
  numbers[at] = value;
  return numbers;
}

// A light at a node.
std::function<void(GltfFile&)> light(const Json& json) {
  return [=](GltfFile& file) {
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({json});
    file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  };
}

// A camera at a node.
std::function<void(GltfFile&)> camera(const Json& json) {
  return [=](GltfFile& file) {
    file.json["cameras"] = Json::array({json});
    file.json["nodes"][1]["camera"] = 0;
  };
}

const std::string light_at = "extensions.KHR_lights_punctual.lights[0]";
const std::string wrong_cone =
    "spot lights whose angles do not grow from 0 to a quarter turn, clamped: 1, the first " + light_at;
const std::string out_of_range =
    "cameras whose aspectRatio, ymag, znear or zfar is out of range, which is ignored: 1, the first "
    "cameras[0].";

}  // namespace

TEST_CASE("rules of glTF: each broken rule gives its message") {
  CHECK(message_of(rich_file()) == "");
  const std::string error = "a.gltf: error: ";
  const std::vector<double> ones(16, 1), flat_normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  const Rule table[] = {
      // Nodes.
      {"matrix and TRS", set("/nodes/1/matrix", identity),
       error + "nodes[1] has both a matrix and a translation, rotation or scale"},
      {"rotation of length 2", set("/nodes/1/rotation", {0, 0, 0, 2}),
       "rotations that are not of unit length, normalised: 1, the first nodes[1].rotation"},
      {"rotation nearly of length 1", set("/nodes/1/rotation", {0, 0, 0, 1.005}), ""},
      {"a scene without the node above, which moves nothing",
       [](GltfFile& file) {
         file.json["nodes"] = {{{"children", {1}}, {"scale", {1, 1, 1}}}, {{"mesh", 0}}};
         file.json["scenes"][0]["nodes"] = {1};
         file.primitive()["attributes"].erase("JOINTS_0");
         file.primitive()["attributes"].erase("WEIGHTS_0");
       },
       "nodes that the scene shows without the nodes above them, which move nothing: 1, the first nodes[1]"},
      {"a scene without the node above the node above, which moves",
       [](GltfFile& file) {
         file.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}, {{"children", {0}}, {"scale", {2, 2, 2}}}};
         file.json["scenes"][0]["nodes"] = {1};
       },
       error + "nodes[2] moves nodes[1], which the scene shows without it: list nodes[2] in the scene in "
               "place of nodes[1], or take nodes[1] out of the children"},
      {"a node below a shown and a hidden tree",
       [](GltfFile& file) {
         file.json["nodes"].push_back({{"children", {1}}, {"translation", {0, 0, 1}}});
       },
       error + "nodes[2] moves nodes[1], which the scene shows without it: list nodes[2] in the scene in "
               "place of nodes[1], or take nodes[1] out of the children"},
      {"no default scene", erase("", "scene"), "it has no default scene: its only scene is shown"},
      {"no default scene of two",
       [](GltfFile& file) {
         file.json.erase("scene");
         file.json["scenes"].push_back(Json::object());
       },
       "it has no default scene: the first of 2 is shown; `gltf_scene` or --gltf-scene shows another: 0, 1"},
      {"no scenes",
       [](GltfFile& file) {
         file.json.erase("scene");
         file.json.erase("scenes");
       },
       "it has no scenes: all nodes without a parent are shown"},
      {"skin without joints in the mesh",
       [](GltfFile& file) {
         file.primitive()["attributes"].erase("JOINTS_0");
         file.primitive()["attributes"].erase("WEIGHTS_0");
       },
       error + attributes_at + " have no JOINTS_0, but the mesh is shown with a skin"},
      {"joints without a skin", erase("/nodes/0", "skin"),
       "meshes with joints that are shown without a skin, undeformed: 1, the first " + attributes_at},
      // Skins and morph targets.
      {"joints without weights", erase("/meshes/0/primitives/0/attributes", "WEIGHTS_0"),
       error + attributes_at + " have one of JOINTS_0 and WEIGHTS_0 without the other"},
      {"inverse bind matrix with another last row",
       [](GltfFile& file) {
         file.json["skins"][0]["inverseBindMatrices"] = file.add(with(identity, 3, 0.5), 5126, "MAT4", 16);
       },
       error + "accessors[8] contains inverseBindMatrices, whose last rows must be 0, 0, 0, 1"},
      {"inverse bind matrices in bytes",
       [](GltfFile& file) {
         file.json["skins"][0]["inverseBindMatrices"] = file.add(identity, 5120, "MAT4", 16);
       },
       error + "accessors[8] contains inverseBindMatrices, which must be floats"},
      {"weights that sum to 4", attribute("WEIGHTS_0", ones, 5126, "VEC4", 4),
       "vertices that name a joint twice, whose weights are added: 1, the first " + attributes_at +
           ".JOINTS_0; weights of joints that do not sum to 1, divided by their sum: 1, the first " +
           attributes_at + ".WEIGHTS_0"},
      {"a negative weight",
       attribute("WEIGHTS_0", {1, -1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4),
       "weights below 0 or not finite, set to 0: 1, the first " + attributes_at + ".WEIGHTS_0"},
      {"more weights than targets", set("/meshes/0/weights", {1, 1}),
       error + "meshes[0].primitives[0] has 1 targets, but 2 weights"},
      // Accessors and views.
      {"no elements", set("/accessors/0/count", 0), error + "accessors[0] has no elements"},
      {"misaligned accessor",
       [](GltfFile& file) {
         file.json["bufferViews"][uv]["byteOffset"] =
             file.json["bufferViews"][uv]["byteOffset"].get<int>() - 2;
         file.json["bufferViews"][uv]["byteLength"] =
             file.json["bufferViews"][uv]["byteLength"].get<int>() + 2;
         for (const char* bound : {"min", "max"}) file.json["accessors"][uv].erase(bound);
       },
       "accessors that do not begin at a multiple of their components' size: 1, the first accessors[3]"},
      {"stride of 13",
       [](GltfFile& file) {
         const int view = file.add_view(std::vector<double>(13 * 3 + 12, 0), 5121);
         file.json["bufferViews"][size_t(view)]["byteStride"] = 13;
         file.json["accessors"][target]["bufferView"] = view;
         file.json["accessors"][target]["min"] = file.json["accessors"][target]["max"] = {0, 0, 0};
       },
       "accessors of attributes whose elements do not begin at multiples of 4 bytes: 1, the first accessors[7]; "
       "strides that are not multiples of 4 from 4 to 252: 1, the first bufferViews[8].byteStride"},
      {"stride of indices", set("/bufferViews/1/byteStride", 4),
       error +
           "accessors[1] is in bufferViews[1], which has a byteStride: only attributes of vertices may have one"},
      {"stride of inverse bind matrices", set("/bufferViews/6/byteStride", 64),
       error +
           "accessors[6] is in bufferViews[6], which has a byteStride: only attributes of vertices may have one"},
      {"normalized indices", set("/accessors/1/normalized", true),
       error + "accessors[1] contains indices, which cannot be normalized"},
      {"min of other data", set("/accessors/0/min", {0, -5, 0}),
       "accessors whose min or max is not that of their data, which are used: 1, the first accessors[0]"},
      {"max of two numbers", set("/accessors/0/max", {1, 1}), error + "accessors[0] has a max of 2 numbers"},
      {"max, rounded", set("/accessors/0/max", {1.0001, 1, 0}), ""},
      {"max of normalized numbers, undeformed stored",
       [](GltfFile& file) {
         attribute("TEXCOORD_0", {0, 0, 255, 0, 255, 255, 0, 255}, 5121, "VEC2", 2, true)(file);
         file.json["accessors"][8]["max"] = {255, 255};
       },
       ""},
      {"sparse of nothing", sparse({0}, 0),
       error + "accessors[0].sparse has a count of 0: it must be from 1 to that of its accessor, 4"},
      {"sparse of more than there are", sparse({0, 1, 2, 3, 3}, 5),
       error + "accessors[0].sparse has a count of 5: it must be from 1 to that of its accessor, 4"},
      {"sparse, not in order", sparse({2, 1}, 2),
       error + "accessors[0].sparse.indices have 1 after 2: they must increase"},
      {"sparse, one twice", sparse({1, 1}, 2),
       error + "accessors[0].sparse.indices have 1 after 1: they must increase"},
      // Attributes.
      {"normals of length 3", attribute("NORMAL", with(with(flat_normals, 2, 3), 5, 3), 5126, "VEC3", 3),
       "normals that are not of unit length, normalised: 1, the first " + attributes_at + ".NORMAL"},
      {"positions in shorts, undeclared", attribute("POSITION", square_positions, 5122, "VEC3", 3),
       "attributes of component types that glTF does not allow for them, read by their componentType: 1, the first accessors[8]"},
      {"positions in 32 bits", attribute("POSITION", square_positions, 5125, "VEC3", 3),
       error + "accessors[8] contains POSITION, which cannot be componentType 5125"},
      {"weights in bytes that are not shares",
       attribute("WEIGHTS_0", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4", 4),
       error + "accessors[8] contains WEIGHTS_0, which cannot be componentType 5121"},
      {"joints as floats", attribute("JOINTS_0", std::vector<double>(16, 0), 5126, "VEC4", 4),
       error + "accessors[8] contains JOINTS_0, which cannot be componentType 5126"},
      {"normalized joints", attribute("JOINTS_0", std::vector<double>(16, 0), 5121, "VEC4", 4, true),
       error + "accessors[8] contains JOINTS_0, which cannot be normalized componentType 5121"},
      {"colours in bytes that are not shares", attribute("COLOR_0", ones, 5121, "VEC4", 4),
       error + "accessors[8] contains COLOR_0, which cannot be componentType 5121"},
      {"corners that make no triangle",
       [](GltfFile& file) {
         file.primitive()["indices"] = file.add({0, 1, 2, 0, 2}, 5123, "SCALAR", 1);
       },
       "primitives whose last corners make no triangle: 1, the first meshes[0].primitives[0]"},
      {"a camera of both types",
       [](GltfFile& file) {
         file.json["nodes"][1]["camera"] = 0;
         file.json["cameras"] = {{{"type", "perspective"},
                                  {"perspective", {{"yfov", 1}, {"znear", 1}}},
                                  {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}}};
       },
       "cameras that are faulty, so they cannot be shown: 1, the first cameras[0]"},
      // Lights.
      {"a light as it should be", light({{"type", "point"}, {"color", {0.5, 0, 1}}, {"intensity", 0}}), ""},
      {"an intensity below 0", light({{"type", "point"}, {"intensity", -1}}),
       error + light_at + " has an intensity that is out of range"},
      {"intensity and colour below 0", light({{"type", "point"}, {"intensity", -1}, {"color", {-1, -1, -1}}}),
       error + light_at + " has an intensity that is out of range"},
      {"a colour above 1", light({{"type", "point"}, {"color", {2, 1, 1}}}),
       "colours of lights above 1, used unchanged: 1, the first " + light_at},
      {"a range of 0", light({{"type", "point"}, {"range", 0}}),
       "left out: ranges of lights (1); ranges of lights that are not above 0: 1, the first " + light_at},
      {"a spot as wide as can be",
       light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0}, {"outerConeAngle", 1.57079637}}}}), ""},
      {"a spot without a cone", light({{"type", "spot"}}), wrong_cone},
      {"a cone that is wider inside",
       light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.4}}}}), wrong_cone},
      {"a cone beyond a quarter turn", light({{"type", "spot"}, {"spot", {{"outerConeAngle", 2}}}}),
       wrong_cone},
      {"a cone of two equal angles",
       light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.3}}}}), wrong_cone},
      {"a cone below 0", light({{"type", "spot"}, {"spot", {{"innerConeAngle", -0.1}}}}), wrong_cone},
      // Names, types and sizes.
      {"an attribute of an unknown name", attribute("TEXCOORD0", std::vector<double>(8, 0), 5126, "VEC2", 2),
       "attributes whose names glTF does not define, left out: 1, the first " + attributes_at + ".TEXCOORD0"},
      {"attributes of an application and of an extension",
       [](GltfFile& file) {
         for (const char* name : {"_HEAT", "KHR_x:SIZE"}) file.primitive()["attributes"][name] = positions;
       },
       ""},
      {"a set of colours without the first", attribute("COLOR_1", ones, 5126, "VEC4", 4),
       "sets of attributes that are not counted from 0: 1, the first " + attributes_at + ".COLOR_1"},
      {"tangents without normals",
       [&](GltfFile& file) {
         attribute("TANGENT", ones, 5126, "VEC4", 4)(file);
         file.primitive()["attributes"].erase("NORMAL");
       },
       "meshes with tangents but without normals; their tangents are computed from uv instead: 1, the first " + attributes_at},
      {"a morph target of normals that are not there",
       [](GltfFile& file) {
         file.primitive()["targets"][0]["NORMAL"] = normals;
         file.primitive()["attributes"].erase("NORMAL");
       },
       "morph targets of attributes that the mesh lacks, left out: 1, the first meshes[0].primitives[0].targets[0]"},
      {"normalized floats", set("/accessors/3/normalized", true),
       "accessors of floats or of 32 bits that are normalized: 1, the first accessors[3]"},
      {"colours above 1", attribute("COLOR_0", std::vector<double>(16, 2), 5126, "VEC4", 4),
       "colours of vertices below 0 or above 1, clamped: 1, the first " + attributes_at + ".COLOR_0"},
      {"a matrix that shears",
       [](GltfFile& file) { file.json["nodes"][1] = {{"matrix", with(identity, 4, 0.5)}}; },
       "matrices of nodes that shear, used unchanged: 1, the first nodes[1].matrix"},
      {"a camera without znear", camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}}}}),
       "properties that glTF requires and the file lacks: 1, the first cameras[0].perspective.znear"},
      {"unused cameras without values",
       [](GltfFile& file) { file.json["cameras"] = {Json::object(), {{"type", "perspective"}}}; },
       "cameras whose type is not that of their values, which are used: 2, the first cameras[0]"},
      {"unused pictures of no source and of two",
       [](GltfFile& file) {
         file.json["images"] = {Json::object(), {{"uri", "x.png"}, {"bufferView", 0}, {"mimeType", "image/png"}}};
       },
       "pictures with both or neither of uri and bufferView: 2, the first images[0]"},
      {"a morph target of an unknown attribute",
       [](GltfFile& file) { file.primitive()["targets"][0]["FOO"] = positions; },
       "attributes whose names glTF does not define, left out: 1, the first meshes[0].primitives[0].targets[0].FOO"},
      {"a cone that is too narrow", light({{"type", "spot"}, {"spot", {{"outerConeAngle", 1e-9}}}}),
       "spot lights whose outerConeAngle is too small to light anything, set to 0.00002: 1, the first " + light_at},
      {"a camera whose zfar is not beyond znear",
       camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 1}}}}),
       out_of_range + "perspective"},
      {"a camera of no width",
       camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", 0}}}}),
       out_of_range + "perspective"},
      {"a camera of no height",
       camera({{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 0}, {"znear", 0}, {"zfar", 9}}}}),
       out_of_range + "orthographic"},
      {"a sound orthographic camera",
       camera({{"type", "orthographic"},
               {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}}),
       ""},
      {"a camera without a type", camera({{"perspective", {{"yfov", 1}, {"znear", 1}}}}),
       "cameras whose type is not that of their values, which are used: 1, the first cameras[0]"},
      // Properties of other names, or at other positions.
      {"a property in another case", set("/materials/0/alphamode", "BLEND"),
       "properties that glTF does not define, left out: 1, the first materials[0].alphamode"},
      {"a property one level too high", set("/materials/0/baseColorFactor", {1, 0, 0, 1}),
       "properties that glTF does not define, left out: 1, the first materials[0].baseColorFactor"},
      {"properties of the document and of a primitive",
       [](GltfFile& file) {
         file.json["node"] = 1;
         file.primitive()["attribute"] = 1;
       },
       "properties that glTF does not define, left out: 2, the first meshes[0].primitives[0].attribute"},
      {"extras and names hold what they like",
       [](GltfFile& file) {
         file.json["extras"]["materials"] = {{{"foo", 1}}};
         file.json["nodes"][1]["extras"] = 5;
         file.json["nodes"][1]["name"] = "n";
         file.json["materials"].push_back(7);
         file.json["materials"].erase(1);
       },
       ""},
      // Materials.
      {"a cutoff without a mask", set("/materials/0/alphaCutoff", 0.25),
       "alpha cutoffs of materials whose alphaMode is not MASK, left out: 1, the first materials[0]"},
      {"a volume that lets no light through",
       [](GltfFile& file) {
         file.json["extensionsUsed"] = {"KHR_materials_volume"};
         file.json["materials"][0]["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 1}};
       },
       "volumes of materials that transmit no light, left out: 1, the first materials[0].extensions.KHR_materials_volume"},
      {"a dispersion below 0",
       [](GltfFile& file) {
         Json& extensions = file.json["materials"][0]["extensions"];
         file.json["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_dispersion"};
         extensions["KHR_materials_transmission"]["transmissionFactor"] = 1;
         extensions["KHR_materials_volume"]["thicknessFactor"] = 1;
         extensions["KHR_materials_dispersion"]["dispersion"] = -1;
       },
       "dispersions below 0 or above 10, clamped: 1, the first materials[0].extensions.KHR_materials_dispersion.dispersion"},
      {"a film of an index below 1",
       [](GltfFile& file) {
         file.json["extensionsUsed"] = {"KHR_materials_iridescence"};
         file.json["materials"][0]["extensions"]["KHR_materials_iridescence"] = {{"iridescenceFactor", 1}, {"iridescenceIor", 0.5}};
       },
       "indices of refraction below 1 or above 4, clamped: 1, the first materials[0].extensions.KHR_materials_iridescence.iridescenceIor"},
      {"an anisotropy above 1",
       [](GltfFile& file) {
         file.json["extensionsUsed"] = {"KHR_materials_anisotropy"};
         file.json["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 2;
       },
       "factors below 0 or above 1, clamped: 1, the first materials[0].extensions.KHR_materials_anisotropy.anisotropyStrength"},
      {"a strength of nothing",
       [](GltfFile& file) {
         file.json["extensionsUsed"] = {"KHR_materials_emissive_strength"};
         file.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 5}};
       },
       "emissive strengths of materials without an emissiveFactor, which emit no light: 1, the first materials[0].extensions.KHR_materials_emissive_strength"},
      {"a joint twice at a vertex",
       attribute("WEIGHTS_0", {0.5, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4),
       "vertices that name a joint twice, whose weights are added: 1, the first " + attributes_at + ".JOINTS_0"},
      {"a camera of the other type",
       [](GltfFile& file) {
         file.json["nodes"][1]["camera"] = 0;
         file.json["cameras"] = {{{"type", "orthographic"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
       },
       "cameras whose type is not that of their values, which are used: 1, the first cameras[0]"},
      {"a later version", set("/asset/version", "2.1"),
       "versions of glTF above 2.0, read as 2.0: 1, the first asset.version"},
      {"a cutoff below 0",
       [](GltfFile& file) { file.json["materials"][0] = {{"alphaMode", "MASK"}, {"alphaCutoff", -1}}; },
       "values of materials below 0, set to 0: 1, the first materials[0].alphaCutoff"},
      {"a strength below 0",
       [](GltfFile& file) {
         Json& material = file.json["materials"][0];
         material["emissiveFactor"] = {1, 1, 1};
         material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = -1;
       },
       "values of materials below 0, set to 0: 1, the first materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength"},
      // The asset.
      {"a minVersion that is read", set("/asset/minVersion", "2.0"), ""},
      {"a minVersion beyond", set("/asset/minVersion", "2.1"),
       error + "it requires glTF 2.1 (asset.minVersion), but eyeray reads 2.0"},
      // Materials.
      {"a factor above 1", set("/materials/0/pbrMetallicRoughness/roughnessFactor", 7),
       "factors below 0 or above 1, clamped: 1, the first materials[0].pbrMetallicRoughness.roughnessFactor"},
      {"an alphaMode that there is not", set("/materials/0/alphaMode", "GLASS"),
       error + "materials[0] has an alphaMode that glTF does not define"},
      {"a required extension that is not declared", set("/extensionsRequired", {"KHR_materials_ior"}),
       "extensions that extensionsUsed does not name: 1, the first KHR_materials_ior"},
      {"an extension of an object that is not declared",
       [](GltfFile& file) {
         file.json["extensionsUsed"] = {"KHR_materials_ior"};
         file.json["materials"][0]["extensions"]["ABC_future"] = Json::object();
         file.json["materials"][0]["extras"]["extensions"]["ABC_other"] = Json::object();
       },
       "left out: the extension ABC_future (1); extensions that extensionsUsed does not name: 1, the first "
       "ABC_future"},
      {"required extensions that are not known",
       [](GltfFile& file) {
         for (const char* list : {"extensionsUsed", "extensionsRequired"})
           file.json[list] = {"ABC_future", "KHR_x", "KHR_materials_ior"};
       },
       "the picture is not as the file intends: it requires ABC_future, KHR_x, which eyeray does not support (extensionsRequired)"},
  };
  check_rules(table);
}

TEST_CASE("rules of glTF: each kind of fault is reported once, with its count and first position") {
  GltfFile file = rich_file();
  for (int i = 2; i < 40; ++i) {
    file.json["nodes"].push_back({{"rotation", {0, 0, 0, 3}}});
    file.json["nodes"][0]["children"].push_back(i);
  }
  CHECK(message_of(file) ==
        "rotations that are not of unit length, normalised: 38, the first nodes[2].rotation");

  // More positions than are remembered one by one.
  GltfFile many = square_file();
  for (int i = 0; i < 70'000; ++i) many.json["nodes"].push_back({{"name", i}});
  CHECK(message_of(many) ==
        "values of another type than that of their property in glTF: 70000, the first nodes[1].name");
}
