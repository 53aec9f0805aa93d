#include "host/core/atomic_file.hpp"
#include "host/image/srgb.hpp"
#include "support.hpp"
#include "tests/support/package.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

const std::string one_object = "<object id=\"1\">" + square_3mf() + "</object>\n";
const std::string one_item = "<item objectid=\"1\"/>\n";

ImportedScene import_model(const std::string& resources, const std::string& build = one_item) {
  return import_sound(package_3mf(model_3mf(resources, build)), "a.3mf");
}

Vec3 corner_of(const ImportedScene& scene, size_t instance, size_t vertex) {
  const Instance& placed = scene.instances[instance];
  return Vec3(placed.transform * Vec4(scene.meshes[size_t(placed.mesh)].positions[vertex], 1));
}

bool is_near(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) < 1e-12;
}

Vec3 linear(int red, int green, int blue) {
  return {image::linear_from_srgb(red / 255.0), image::linear_from_srgb(green / 255.0),
          image::linear_from_srgb(blue / 255.0)};
}

}  // namespace

TEST_CASE("3MF: z points up, and units become millimetres") {
  const ImportedScene scene = import_model(one_object);
  CHECK(import_sound(package_3mf(model_3mf(one_object, one_item), {}, true), "a.3mf").instances.size() == 1);
  REQUIRE(scene.meshes.size() == 1);
  CHECK(scene.meshes[0].triangles.size() == 2);
  CHECK(scene.meshes[0].positions.size() == 4);
  CHECK(scene.meshes[0].colors.empty());
  CHECK(scene.warnings.empty());
  REQUIRE(scene.instances.size() == 1);
  CHECK(scene.instances[0].material == -1);
  CHECK(is_near(corner_of(scene, 0, 2), {1, 0, -1}));

  for (const auto& [unit, size] : {std::pair("micron", 0.001),
                                   {"centimeter", 10.0},
                                   {"inch", 25.4},
                                   {"foot", 304.8},
                                   {"meter", 1000.0}}) {
    const ImportedScene other = import_sound(package_3mf(model_3mf(one_object, one_item, unit)), "a.3MF");
    CHECK(is_near(corner_of(other, 0, 2), {size, 0, -size}));
  }
  CHECK(import_sound(package_3mf(model_3mf(one_object, one_item)), "a.3mf", {.up = UpAxis::z})
            .instances[0]
            .transform == scene.instances[0].transform);
  CHECK(contains(refusal(package_3mf(model_3mf(one_object, one_item)), "a.3mf", {.up = UpAxis::x}),
                 "+z is up in 3MF, by its specification"));
  CHECK(contains(refusal(package_3mf(model_3mf(one_object, one_item, "ell")), "a.3mf"),
                 "a.3mf, 3D/3dmodel.model:2:1: error: `unit` is micron, millimeter"));
}

TEST_CASE("3MF: the build places objects, and components place others, also from other parts") {
  const std::string components =
      "<object id=\"2\"><components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 6 7\"/>"
      "<component objectid=\"1\" transform=\"0 2 0 -1 0 0 0 0 1 0 0 0\"/></components></object>\n"
      "<object id=\"3\"><components><component objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 100 0 0\"/>"
      "</components></object>\n";
  const ImportedScene scene =
      import_model(one_object + components,
                   "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 0 0 10\"/><item objectid=\"1\"/>");
  CHECK(scene.meshes.size() == 1);
  REQUIRE(scene.instances.size() == 3);
  // (1, 1, 0) is moved by (5, 6, 7), (100, 0, 0) and (0, 0, 10); then z becomes y, and y −z.
  CHECK(is_near(corner_of(scene, 0, 2), {106, 17, -7}));
  // Its x axis becomes twice y, its y axis −x.
  CHECK(is_near(corner_of(scene, 1, 2), {99, 10, -2}));
  CHECK(is_near(corner_of(scene, 2, 2), {1, 0, -1}));

  const std::string other = model_3mf("<object id=\"1\">" + square_3mf() + "</object>", "");
  const std::string outer =
      "<object id=\"1\"><components><component p:path=\"/3D/Objects/One.model\" "
      "objectid=\"1\"/></components></object>";
  const ImportedScene parts = import_sound(
      package_3mf(
          model_3mf(outer, "<item objectid=\"1\"/><item objectid=\"1\" p:path=\"/3d/objects/one.model\"/>"),
          {{"3D/Objects/One.model", other}}),
      "a.3mf");
  CHECK(parts.meshes.size() == 1);
  CHECK(parts.instances.size() == 2);

  // A transform that flattens an object leaves it out.
  const ImportedScene flat =
      import_model(one_object, one_item + "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"/>");
  CHECK(flat.instances.size() == 1);
  CHECK(warns(flat, "objects whose transforms cannot be inverted were left out: 1"));
}

TEST_CASE("3MF: base materials and color groups give colors to objects, triangles and corners") {
  const std::string groups =
      "<basematerials id=\"5\"><base name=\"a\" displaycolor=\"#FF8000\"/><base name=\"b\" "
      "displaycolor=\"#0000FFff\"/></basematerials>"
      "<m:colorgroup id=\"6\"><m:color color=\"#FF0000FF\"/><m:color color=\"#00ff00FF\"/><m:color "
      "color=\"#102030FF\"/></m:colorgroup>";
  const ImportedScene whole =
      import_model(groups + "<object id=\"1\" pid=\"5\" pindex=\"1\">" + square_3mf() + "</object>");
  CHECK(whole.meshes[0].colors == std::vector<Vec3>(4, Vec3(0, 0, 1)));
  CHECK(whole.instances[0].material == -1);
  CHECK(whole.warnings.empty());

  const ImportedScene faces = import_model(groups + "<object id=\"1\" pid=\"5\" pindex=\"1\">" +
                                           square_3mf("p1=\"0\"") + "</object>");
  const Mesh& mesh = faces.meshes[0];
  for (size_t i = 0; i < 3; ++i) {
    CHECK(mesh.colors[mesh.triangles[0][i]] == linear(255, 128, 0));
    CHECK(mesh.colors[mesh.triangles[1][i]] == Vec3(0, 0, 1));
  }
  CHECK(mesh.positions.size() == 6);

  // Corners of one triangle differ; a triangle without a property is grey.
  const ImportedScene corners = import_model(
      groups + "<object id=\"1\">" + square_3mf("pid=\"6\" p1=\"0\" p2=\"1\" p3=\"2\"") + "</object>");
  const Mesh& shaded = corners.meshes[0];
  CHECK(shaded.colors[shaded.triangles[0][0]] == Vec3(1, 0, 0));
  CHECK(shaded.colors[shaded.triangles[0][1]] == Vec3(0, 1, 0));
  CHECK(shaded.colors[shaded.triangles[0][2]] == linear(16, 32, 48));
  CHECK(shaded.colors[shaded.triangles[1][0]] == Vec3(0.75));

  const ImportedScene clear = import_model(
      "<m:colorgroup id=\"6\"><m:color color=\"#FF000080\"/></m:colorgroup>"
      "<object id=\"1\" pid=\"6\" pindex=\"0\">" +
      square_3mf() + "</object>");
  CHECK(warns(clear, "transparent colors are shown as opaque; a `material` with `alpha` would count: 1"));
}

TEST_CASE("3MF: pictures by the uv of their groups, beside colors") {
  const std::string picture = read_file("tests/image/pictures/rgb.png");
  const std::string resources =
      "<m:texture2d id=\"7\" path=\"/3D/Textures/a.png\" contenttype=\"image/png\" tilestyleu=\"mirror\" "
      "tilestylev=\"none\" filter=\"nearest\"/>"
      "<m:texture2dgroup id=\"8\" texid=\"7\"><m:tex2coord u=\"0\" v=\"0\"/><m:tex2coord u=\"1\" "
      "v=\"0\"/><m:tex2coord u=\"1\" v=\"1\"/></m:texture2dgroup>"
      "<m:colorgroup id=\"6\"><m:color color=\"#FF0000\"/></m:colorgroup>"
      "<object id=\"1\" name=\"tile\">" +
      square_3mf("pid=\"8\" p1=\"0\" p2=\"1\" p3=\"2\"", "pid=\"6\" p1=\"0\"") + "</object>";
  const ImportedScene scene =
      import_sound(package_3mf(model_3mf(resources, one_item), {{"3D/Textures/a.png", picture}}), "a.3mf");
  REQUIRE(scene.meshes.size() == 2);
  REQUIRE(scene.materials.size() == 1);
  REQUIRE(scene.instances.size() == 2);
  CHECK(scene.instances[0].material == -1);
  CHECK(scene.meshes[0].colors == std::vector<Vec3>(3, Vec3(1, 0, 0)));
  CHECK(scene.meshes[0].uv.empty());
  CHECK(scene.instances[1].material == 0);
  CHECK(scene.meshes[1].uv == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}});
  CHECK(scene.meshes[1].colors == std::vector<Vec3>(3, Vec3(1)));
  CHECK(scene.meshes[1].name == "a.3mf, tile");
  CHECK(scene.warnings ==
        std::vector<std::string>{"ends of pictures (tilestyle none) are shown as clamp: 1"});

  // A picture that cannot be read is left out, with a warning.
  const ImportedScene none = import_sound(package_3mf(model_3mf(resources, one_item)), "a.3mf");
  CHECK(none.materials.empty());
  CHECK(none.instances.size() == 2);
  CHECK(warns(none, "a picture was left out: "));
  CHECK(warns(none, "it has no part /3D/Textures/a.png"));
}

TEST_CASE("3MF: warnings count what is left out") {
  const ImportedScene scene = import_model(
      "<m:compositematerials id=\"4\" matid=\"1\" matindices=\"0\"><m:composite "
      "values=\"1\"/></m:compositematerials>"
      "<object id=\"1\">" +
      square_3mf(
          "pid=\"4\" p1=\"0\"", "",
          "<b:beamlattice minlength=\"1\" radius=\"1\"><b:beams><b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"1\" "
          "v2=\"2\"/></b:beams></b:beamlattice>") +
      "</object>");
  CHECK(scene.warnings ==
        std::vector<std::string>{"beams of lattices were left out: 2",
                                 "groups of mixed materials (compositematerials) were left out: 1"});
  CHECK(contains(refusal(package_3mf(model_3mf(one_object, "")), "a.3mf"),
                 "its build is empty, so that none of its objects is shown"));
}

TEST_CASE("3MF that is faulty is refused at its line") {
  const auto refused = [](const std::string& resources, const std::string& build, const std::string& at,
                          const std::string& why) {
    CAPTURE(resources);
    const std::string message = refusal(package_3mf(model_3mf(resources, build)), "a.3mf");
    CAPTURE(message);
    CHECK(message.starts_with("a.3mf, 3D/3dmodel.model:" + at + ": error: "));
    CHECK(contains(message, why));
  };
  refused("<object id=\"1\">" + square_3mf("p1=\"0\"") + "</object>", one_item, "7:1", "`p1` needs a `pid`");
  refused("<object id=\"1\">" + square_3mf("pid=\"3\" p1=\"0\"") + "</object>", one_item, "7:1",
          "there is no group of properties 3 before this line");
  refused("<m:colorgroup id=\"3\"><m:color color=\"#123456\"/></m:colorgroup><object id=\"1\">" +
              square_3mf("pid=\"3\" p1=\"0\" p3=\"1\"") + "</object>",
          one_item, "7:1", "there is no property 1: group 3 has 1, counted from 0");
  refused("<m:colorgroup id=\"3\"><m:color color=\"#12345\"/></m:colorgroup>", one_item, "4:22",
          "`color` is a color such as #FF8000");
  refused("<m:texture2dgroup id=\"3\" texid=\"9\"/>", one_item, "4:1",
          "there is no picture 9 before this line");
  refused("<object id=\"1\"/>\n<object id=\"1\"/>", one_item, "5:1",
          "ids are above 0 and different, and this is 1");
  refused("<object id=\"0\"/>", one_item, "4:1", "ids are above 0");
  refused("<object/>", one_item, "4:1", "`id` is missing here");
  refused("<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"a\" z=\"0\"/></vertices></mesh></object>",
          one_item, "4:32", "`y` is not a number");
  refused(
      "<object id=\"1\"><mesh><vertices/><triangles><triangle v1=\"0\" v2=\"0\" "
      "v3=\"0\"/></triangles></mesh></object>",
      one_item, "4:44", "there is no vertex 0: the mesh has 0");
  refused(
      "<object id=\"1\"><mesh><vertices/><triangles><triangle v1=\"-1\" v2=\"0\" "
      "v3=\"0\"/></triangles></mesh></object>",
      one_item, "4:44", "`v1` is a whole number from 0 to 4294967294");
  refused(one_object, "<item objectid=\"1\" transform=\"1 2 3\"/>", "12:1", "`transform` is not a number");
}

TEST_CASE("3MF: components that contain themselves, too deep and too many are refused") {
  const auto object = [](int id, const std::vector<int>& components) {
    std::string text = "<object id=\"" + std::to_string(id) + "\"><components>";
    for (const int each : components) text += "<component objectid=\"" + std::to_string(each) + "\"/>";
    return text + "</components></object>\n";
  };
  const auto refused = [](const std::string& resources, const std::string& why) {
    const std::string message = refusal(package_3mf(model_3mf(resources, one_item)), "a.3mf");
    CAPTURE(message);
    CHECK(message.starts_with("a.3mf, 3D/3dmodel.model:"));
    CHECK(contains(message, why));
  };
  refused(object(1, {2}) + object(2, {1}), "object 1 contains itself");
  refused(object(1, {2}), "there is no object 2");
  std::string chain, doubling;
  for (int id = 1; id < 60; ++id) {
    chain += object(id, {id + 1});
    if (id < 30) doubling += object(id, {id + 1, id + 1});
  }
  refused(chain + object(60, {}), "components are nested more than 32 deep");
  refused(doubling + object(30, {}), "the build has more than 1048576 objects, with all their components");
  refused(
      "<object id=\"1\"><components><component p:path=\"/3D/b.model\" objectid=\"1\"/></components></object>",
      "the file has no part /3D/b.model");
}

TEST_CASE("3MF: packages and XML that are hostile are refused") {
  CHECK(contains(refusal("", "a.3mf"), "it is no 3MF: it is not a ZIP archive"));
  CHECK(contains(refusal("PK and more", "a.3mf"), "it is not a ZIP archive"));
  CHECK(contains(refusal(zip_of({{"a", "b"}}), "a.3mf"), "a.3mf: error: it has no part _rels/.rels"));
  CHECK(contains(refusal(zip_of({{"_rels/.rels", "<a/>"}}), "a.3mf"), "name no 3D model"));
  CHECK(contains(refusal(zip_of({{"_rels/.rels", "<a/>"}}, false, 1), "a.3mf"),
                 "part _rels/.rels: it is encrypted"));
  const std::string whole = package_3mf(model_3mf(one_object, one_item));
  std::string changed = whole;
  changed[changed.find("x=\"1\"") + 3] = '2';
  CHECK(contains(refusal(changed, "a.3mf"),
                 "cannot read its part 3D/3dmodel.model: it is damaged: its checksum"));

  // A bomb: 80 MiB of blanks in 80 KB.
  const std::string bomb = package_3mf("<model>" + std::string(size_t{80} << 20, ' '), {}, true);
  CHECK(bomb.size() < 100'000);
  CHECK(contains(refusal(bomb, "a.3mf"), "its parts unpack to more bytes than a file of this size may have"));

  const auto refused = [](const std::string& model, const std::string& why) {
    const std::string message = refusal(package_3mf(model), "a.3mf");
    CAPTURE(message);
    CHECK(message.starts_with("a.3mf, 3D/3dmodel.model:"));
    CHECK(contains(message, why));
  };
  refused("<!DOCTYPE model [<!ENTITY a \"aaaa\">]><model>&a;</model>",
          "a document type (DOCTYPE) is not allowed here");
  refused("<model>&a;</model>", "no well-formed XML (undefined entity)");
  refused("<model><a></model>", "no well-formed XML (mismatched tag)");
  refused("<model>", "no well-formed XML (no element found)");
  refused("", "no well-formed XML (no element found)");
  std::string deep;
  for (int i = 0; i < 70; ++i) deep += "<a>";
  refused(deep, "elements are nested more than 64 deep");
  refused("<model a=\"" + std::string(size_t{3} << 20, 'x') + "\"/>", "longer than 1 MiB");
}
