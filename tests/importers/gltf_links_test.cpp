// Errors and warnings for glTF whose values or references break rules, in objects that are shown or not: one
// row for each rule.
#include "gltf_rich_file.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// Adds an object to a list of the document.
std::function<void(GltfFile&)> add_object(const char* list, const Json& object) {
  return [=](GltfFile& file) { file.json[list].push_back(object); };
}

// The file with its morph target made of another accessor, and without weight.
std::function<void(GltfFile&)> hidden_target(const char* pointer, const Json& value) {
  return [=](GltfFile& file) {
    file.json["meshes"][0].erase("weights");
    file.json[Json::json_pointer(pointer)] = value;
  };
}

// An animation of node 1 with a key at 0.
std::function<void(GltfFile&)> animate(const char* path, const char* interpolation, size_t outputs) {
  return [=](GltfFile& file) {
    const int input = file.add({0}, 5126, "SCALAR", 1);
    const int output = file.add(std::vector<double>(3 * outputs, 1), 5126, "VEC3", 3);
    file.json["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", path}}}}}}}};
  };
}

const std::string empty_text = "lists and objects that are empty, which glTF does not allow: 1, the first ";
const std::string missing_text = "properties that glTF requires and the file lacks: 1, the first ";
const std::string mismatch_text = "values of another type than that of their property in glTF: 1, the first ";
const std::string out_of_range_text = "values that glTF does not allow for their property: 1, the first ";
const std::string twice_text = "lists that contain the same element twice: 1, the first ";
const std::string nowhere_text = "indices of objects that the file does not have: 1, the first ";
const std::string undefined_text = "properties that glTF does not define, left out: 1, the first ";
const std::string hidden_text =
    "morph targets that could not be shown with a weight: 1, the first "
    "meshes[0].primitives[0].targets[0]";

}  // namespace

TEST_CASE("rules of glTF: properties, their types, ranges and lists") {
  const Rule table[] = {
      {"a list without elements", set("/animations", Json::array()), empty_text + "animations"},
      {"a scene without nodes that is not shown", add_object("scenes", {{"nodes", Json::array()}}),
       empty_text + "scenes[1].nodes"},
      {"a mesh without primitives", add_object("meshes", {{"primitives", Json::array()}}),
       empty_text + "meshes[1].primitives"},
      {"a morph target of nothing", hidden_target("/meshes/0/primitives/0/targets/0", Json::object()),
       empty_text + "meshes[0].primitives[0].targets[0]"},
      {"lights without a light", set("/extensions/KHR_lights_punctual/lights", Json::array()),
       empty_text + "extensions.KHR_lights_punctual.lights"},
      {"an accessor without a type", add_object("accessors", {{"componentType", 5126}, {"count", 1}}),
       missing_text + "accessors[8].type"},
      {"a mesh that lacks its primitives", add_object("meshes", Json::object()),
       missing_text + "meshes[1].primitives"},
      {"a light that lacks its type",
       set("/extensions/KHR_lights_punctual/lights", Json::array({Json::object()})),
       missing_text + "extensions.KHR_lights_punctual.lights[0].type"},
      {"an animation whose channel has no path",
       [](GltfFile& file) {
         animate("translation", "LINEAR", 1)(file);
         Json second = file.json["animations"][0];
         second["channels"][0]["target"].erase("path");
         file.json["animations"].push_back(second);
       },
       missing_text + "animations[1].channels[0].target.path"},
      {"a name that is a number", set("/nodes/1/name", 5), mismatch_text + "nodes[1].name"},
      {"extensions that are a list", set("/asset/extensions", Json::array()),
       mismatch_text + "asset.extensions"},
      {"a camera that is no object, and no node has",
       set("/cameras", Json::array({Json{{"type", "perspective"}, {"perspective", 5}}})),
       mismatch_text + "cameras[0].perspective"},
      {"an image that is no object, and nothing shows", set("/images", {7}), mismatch_text + "images[0]"},
      {"a flag that is a number",
       add_object("accessors", {{"componentType", 5126}, {"type", "VEC2"}, {"count", 1}, {"normalized", 1}}),
       mismatch_text + "accessors[8].normalized"},
      {"an index that is below 0", set("/textures", {{{"source", -1}}}),
       mismatch_text + "textures[0].source"},
      {"a list that is a number", set("/samplers", 5), mismatch_text + "samplers"},
      {"a view of no bytes", add_object("bufferViews", {{"buffer", 0}, {"byteLength", 0}}),
       out_of_range_text + "bufferViews[8].byteLength"},
      {"a target of views that there is not", set("/bufferViews/0/target", 5),
       out_of_range_text + "bufferViews[0].target"},
      {"a sampler that nothing uses", set("/samplers", {{{"wrapS", 3}}}),
       out_of_range_text + "samplers[0].wrapS"},
      {"sound values of samplers", set("/samplers", {{{"wrapS", 10497}, {"wrapT", 33071.0}}}), ""},
      {"an unknown type of accessor",
       add_object("accessors", {{"componentType", 5126}, {"type", "VEC5"}, {"count", 1}}),
       out_of_range_text + "accessors[8].type"},
      {"a matrix of 3 numbers in a node that is not shown", add_object("nodes", {{"matrix", {1, 0, 0}}}),
       out_of_range_text + "nodes[2].matrix"},
      {"an extension used twice", set("/extensionsUsed", {"KHR_materials_ior", "KHR_materials_ior"}),
       twice_text + "extensionsUsed"},
      {"a joint that a skin lists twice",
       [](GltfFile& file) { file.json["skins"][0] = {{"joints", {1, 1}}}; }, twice_text + "skins[0].joints"},
      {"a skeleton that there is not", set("/skins/0/skeleton", 7), nowhere_text + "skins[0].skeleton"},
      {"an image that there is not, in a texture that nothing shows", set("/textures", {{{"source", 0}}}),
       nowhere_text + "textures[0].source"},
      {"a material of an occlusion map that there is not",
       set("/materials/0/occlusionTexture", {{"index", 0}}),
       "left out: occlusion maps (1); " + nowhere_text + "materials[0].occlusionTexture.index"},
      {"a slip in a property of an extension",
       set("/materials/0/extensions/KHR_materials_clearcoat", {{"clearCoatFactor", 1}}),
       undefined_text + "materials[0].extensions.KHR_materials_clearcoat.clearCoatFactor"},
      {"an extension of materials in a node", set("/nodes/1/extensions/KHR_materials_unlit", Json::object()),
       "extensions of objects to which they do not apply, left out: 1, the first "
       "nodes[1].extensions.KHR_materials_unlit"},
      {"an extension that is in no object", set("/nodes/1/extensions/KHR_mesh_quantization", Json::object()),
       "extensions of objects to which they do not apply, left out: 1, the first "
       "nodes[1].extensions.KHR_mesh_quantization"},
      {"an unknown extension holds what it likes", set("/nodes/1/extensions/ABC_future", {{"mesh", "x"}}),
       "left out: the extension ABC_future (1)"},
      // Values that readers check.
      {"materials that are lit and not",
       [](GltfFile& file) {
         Json& extensions = file.json["materials"][0]["extensions"];
         extensions["KHR_materials_unlit"] = Json::object();
         extensions["KHR_materials_ior"]["ior"] = 1.4;
       },
       "materials with extensions that exclude each other: 1, the first materials[0]"},
      {"an attenuation at no distance",
       [](GltfFile& file) {
         Json& extensions = file.json["materials"][0]["extensions"];
         extensions["KHR_materials_transmission"]["transmissionFactor"] = 0.25;
         extensions["KHR_materials_volume"]["attenuationDistance"] = 0;
       },
       "attenuation distances that are not above 0, left out: 1, the first "
       "materials[0].extensions.KHR_materials_volume"},
      {"a point light with a cone",
       [](GltfFile& file) {
         file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
             {{"type", "point"}, {"spot", Json::object()}}};
         file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
       },
       "cones of lights that are not spot lights, left out: 1, the first "
       "extensions.KHR_lights_punctual.lights[0]"},
      {"a joint that there is not, without weight",
       attribute("JOINTS_0", {0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 4),
       "vertices that name joints beyond the skin's without weight, left out: 1, the first " + attributes_at +
           ".JOINTS_0"},
      {"a weight that is no number",
       attribute("WEIGHTS_0", {1, double(NAN), 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4),
       "weights below 0 or not finite, set to 0: 1, the first " + attributes_at + ".WEIGHTS_0"},
      {"a morph target of fewer vertices, without weight", hidden_target("/accessors/7/count", 3),
       hidden_text},
      {"a morph target beyond its view, without weight", hidden_target("/accessors/7/byteOffset", 400),
       hidden_text},
      {"a morph target of another type, without weight", hidden_target("/accessors/7/type", "VEC4"),
       hidden_text},
      {"a sound morph target without weight", hidden_target("/meshes/0/weights", {0}), ""},
      {"animated weights of nothing", animate("weights", "LINEAR", 1),
       "animated weights of nodes without morph targets, left out: 1, the first "
       "animations[0].channels[0].target"},
      {"a spline of one key", animate("translation", "CUBICSPLINE", 3),
       "animations along splines with one key, which do not move: 1, the first animations[0].samplers[0]"},
  };
  check_rules(table);
}

TEST_CASE("rules of glTF: nodes, skins, and what accessors and views hold") {
  const std::string skeleton =
      "skins whose skeleton is not above all joints, left out: 1, the first skins[0]";
  const auto two_joints = [](const Json& root, const Json& children, const Json& top) {
    return [=](GltfFile& file) {
      file.json["nodes"].push_back(Json::object());
      file.json["nodes"][0]["children"] = children;
      file.json["scenes"][0]["nodes"] = top;
      file.json["skins"][0] = {{"joints", {1, 2}}};
      if (!root.is_null()) file.json["skins"][0]["skeleton"] = root;
    };
  };
  const Json position = {{"POSITION", positions}};
  const Json skinned = {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}};
  const Rule table[] = {
      {"a node below two others that are not shown",
       [](GltfFile& file) {
         for (const Json& node : {Json{{"children", {4}}}, Json{{"children", {4}}}, Json::object()})
           file.json["nodes"].push_back(node);
       },
       "nodes of several parents: 1, the first nodes[4]"},
      {"nodes below each other that are not shown",
       [](GltfFile& file) {
         file.json["nodes"].push_back({{"children", {3}}});
         file.json["nodes"].push_back({{"children", {2, 4}}});
         file.json["nodes"].push_back(Json::object());
       },
       "nodes in or below a loop: 3, the first nodes[2]"},
      {"a skin without a mesh", set("/nodes/1/skin", 0),
       "nodes with a skin, weights or instances but no mesh, which have no effect: 1, the first nodes[1]"},
      {"weights without a mesh", set("/nodes/1/weights", {1}),
       "nodes with a skin, weights or instances but no mesh, which have no effect: 1, the first nodes[1]"},
      {"primitives of one and of no morph target",
       add_object("meshes",
                  {{"primitives",
                    {{{"attributes", position}, {"targets", {position}}}, {{"attributes", position}}}}}),
       "meshes whose primitives differ in their number of morph targets: 1, the first meshes[1]"},
      {"primitives with and without joints",
       add_object("meshes", {{"primitives", {{{"attributes", position}}, {{"attributes", skinned}}}}}),
       "meshes whose primitives differ in their number of sets of joints: 1, the first meshes[1]"},
      {"joints of two trees", two_joints(nullptr, {1}, {0, 2}),
       "skins whose joints have no common root, used where they are: 1, the first skins[0]"},
      {"joints of one tree", two_joints(nullptr, {1, 2}, {0}), ""},
      {"a skeleton above all joints", two_joints(0, {1, 2}, {0}), ""},
      {"a skeleton that is one of two joints", two_joints(1, {1, 2}, {0}), skeleton},
      {"a skeleton that is the last of two joints", two_joints(2, {1, 2}, {0}), skeleton},
      {"a skeleton that is the only joint", set("/skins/0/skeleton", 1), ""},
      {"matrices as an attribute",
       [](GltfFile& file) { file.primitive()["attributes"]["_X"] = bind_matrices; },
       "accessors that are more than one of attributes, indices and other data: 1, the first accessors[6]; "
       "views that contain more than one of attributes, indices and other data: 1, the first bufferViews[6]"},
      {"positions without min", erase("/accessors/0", "min"),
       "accessors of positions or times without min and max: 1, the first accessors[0]"},
      {"a morph target without max", erase("/accessors/7", "max"),
       "accessors of positions or times without min and max: 1, the first accessors[7]"},
      {"times without max",
       [](GltfFile& file) {
         animate("translation", "STEP", 1)(file);
         file.json["accessors"][8].erase("max");
       },
       "accessors of positions or times without min and max: 1, the first accessors[8]"},
      {"normals without min and max",
       [](GltfFile& file) {
         file.json["accessors"][normals].erase("min");
         file.json["accessors"][normals].erase("max");
       },
       ""},
      {"colours of 3 bytes each",
       [](GltfFile& file) {
         attribute("COLOR_0", std::vector<double>(12, 0), 5121, "VEC3", 3, true)(file);
         file.json["bufferViews"][8].erase("byteStride");
       },
       "accessors of attributes whose elements do not begin at multiples of 4 bytes: 1, the first "
       "accessors[8]"},
      {"colours of 3 bytes in 4", attribute("COLOR_0", std::vector<double>(12, 0), 5121, "VEC3", 3, true),
       ""},
      {"positions in a view for indices", set("/bufferViews/0/target", 34963),
       "views whose target does not fit their accessors: 1, the first bufferViews[0]"},
      {"indices in a view for attributes", set("/bufferViews/1/target", 34962),
       "views whose target does not fit their accessors: 1, the first bufferViews[1]"},
      {"matrices in a view for attributes", set("/bufferViews/6/target", 34962),
       "views whose target does not fit their accessors: 1, the first bufferViews[6]"},
      {"right targets",
       [](GltfFile& file) {
         file.json["bufferViews"][0]["target"] = 34962;
         file.json["bufferViews"][1]["target"] = 34963;
       },
       ""},
      {"two attributes in a view",
       [](GltfFile& file) {
         file.json["accessors"].push_back(file.json["accessors"][uv]);
         file.primitive()["attributes"]["TEXCOORD_1"] = 8;
       },
       "views of several attributes without a byteStride, read as packed: 1, the first bufferViews[3]"},
      {"two attributes in a view with a stride",
       [](GltfFile& file) {
         file.json["accessors"].push_back(file.json["accessors"][uv]);
         file.primitive()["attributes"]["TEXCOORD_1"] = 8;
         file.json["bufferViews"][uv]["byteStride"] = 8;
       },
       ""},
  };
  check_rules(table);
}

TEST_CASE("rules of glTF: indices that begin a strip anew, and data of another type than a buffer's") {
  GltfFile file;
  std::vector<double> many(256 * 3, 0.5);
  std::copy(square_positions.begin(), square_positions.end(), many.begin());
  std::copy_n(square_positions.end() - 3, 3, many.end() - 3);
  file.add_positions(many);
  file.primitive()["indices"] = file.add({0, 1, 255}, 5121, "SCALAR", 1);
  CHECK(message_of(file) ==
        "indices that begin a new strip in other readers, read as those of vertices: 1, the first "
        "accessors[1]");
  file.primitive()["indices"] = file.add({0, 1, 255}, 5123, "SCALAR", 1);
  CHECK(message_of(file) == "");

  const std::string text = square_file().gltf("data:text/plain;base64," + base64(square_file().data()));
  CHECK(import_sound(text, "a.gltf").warnings ==
        std::vector<std::string>{
            "data URIs of buffers of another type than application/octet-stream: 1, the first buffers[0]"});
}

TEST_CASE("rules of glTF: chunks of .glb") {
  const std::string sound = square_file().glb();
  const auto with_chunk = [](std::string glb, size_t at, uint32_t type, const std::string& data) {
    glb.insert(at, Bytes().add(uint32_t(data.size())).add(type).text() + data);
    return glb.replace(8, 4, Bytes().add(uint32_t(glb.size())).text());
  };
  const auto warnings_of = [](const std::string& glb) { return import_sound(glb, "a.glb").warnings; };
  using Warnings = std::vector<std::string>;
  constexpr uint32_t binary = 0x004e4942, unknown = 0x12345678;
  const size_t second = sound.find("BIN") - 4;
  CHECK(warnings_of(sound) == Warnings{});
  CHECK(warnings_of(with_chunk(sound, sound.size(), unknown, "abcd")) ==
        Warnings{"chunks of .glb of a type that glTF does not define, left out: 1, the first the file"});
  CHECK(warnings_of(with_chunk(sound, second, unknown, "abcd")) ==
        Warnings{"chunks of .glb of a type that glTF does not define, left out: 1, the first the file",
                 "binary chunks of .glb that are not the second chunk: 1, the first the file"});
  std::string longer = sound + "ab";
  longer.replace(8, 4, Bytes().add(uint32_t(longer.size())).text());
  CHECK(warnings_of(longer) ==
        Warnings{"bytes after the last chunk of .glb, left out: 1, the first the file"});

  // A binary chunk in a file whose buffers are elsewhere.
  std::string json = square_file().gltf();
  while (json.size() % 4 != 0) json += ' ';
  std::string glb = Bytes().add(uint32_t(0x46546c67)).add(uint32_t(2)).add(uint32_t(20 + json.size())).text();
  glb += Bytes().add(uint32_t(json.size())).add(uint32_t(0x4e4f534a)).text() + json;
  CHECK(warnings_of(glb) == Warnings{});
  CHECK(warnings_of(with_chunk(glb, glb.size(), binary, "abcd")) ==
        Warnings{"binary chunks of .glb that no buffer uses, left out: 1, the first the file"});
}
