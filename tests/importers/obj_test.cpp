#include <algorithm>
#include <numbers>

#include "host/image/image_file.hpp"
#include "host/image/srgb.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("a square is read in every notation of indices") {
  const std::string extra = square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n";
  for (const char* face :
       {"f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1 4//1", "f 1/1/1 2/2/1 3/3/1 4/4/1",
        "f -4 -3 -2 -1", "f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1", "f 1 2 \\\n3 4", "  f\t1  2\t3 4 \r",
        "f 1 2 3 4 # a square", "f 1 2 3\nf 1 3 4", "fo 1 2 3 4"}) {
    CAPTURE(face);
    const ImportedScene scene = import_sound(extra + face + "\n", "a.obj");
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes[0].triangles.size() == 2);
    CHECK(scene.meshes[0].positions.size() == 4);
    CHECK(signed_area(scene.meshes[0], {0, 0, 1}) == 2);
    for (const Vec3& normal : scene.meshes[0].normals) CHECK(normal == Vec3(0, 0, 1));
    const bool has_uv = std::string(face).find("/1") != std::string::npos &&
                        std::string(face).find("//") == std::string::npos;
    for (size_t i = 0; has_uv && i < 4; ++i)
      CHECK(scene.meshes[0].uv[i] == Vec2(scene.meshes[0].positions[i]));
  }
}

TEST_CASE("faces may come before their vertices, and a file needs no line break at its end") {
  CHECK(import_sound("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0", "a.obj").meshes[0].triangles.size() == 1);
}

TEST_CASE("wrong OBJ is refused at its line and column") {
  const auto message = [](const std::string& rest) { return refusal(square + rest, "a.obj"); };
  CHECK(message("f 1 2 5") == "a.obj:5:7: error: there is no vertex 5: the file has 4");
  CHECK(message("f 1 2 0") == "a.obj:5:7: error: indices count from 1, so 0 is not allowed");
  CHECK(message("f 1 2 -5") == "a.obj:5:7: error: there is no vertex -5: the file has 4 up to here");
  CHECK(message("f 1/1 2/1 3/1") == "a.obj:5:5: error: there is no texture coordinate 1: the file has 0");
  CHECK(message("f 1//1 2//1 3//1") == "a.obj:5:6: error: there is no normal 1: the file has 0");
  CHECK(message("f 1 2 x") == "a.obj:5:7: error: this is not an index of a vertex");
  CHECK(message("f 1 2 3.5") == "a.obj:5:8: error: a corner of a face is written 1, 1/2, 1//3 or 1/2/3");
  CHECK(message("f 1 2 99999999999999999999") == "a.obj:5:7: error: this is not an index of a vertex");
  CHECK(message("f 1 2 4294967296") == "a.obj:5:7: error: there is no vertex 4294967296");
  CHECK(message("v 1 2") == "a.obj:5:1: error: a vertex has three numbers");
  CHECK(message("v 1,5 2 3") == "a.obj:5:3: error: this is not a number");
  CHECK(message("v 1 2 3x") == "a.obj:5:7: error: this is not a number");
  CHECK(message("vn 1 2") == "a.obj:5:1: error: a normal has three numbers");
  CHECK(message("") == "accepted");  // its vertices are shown as points
  CHECK(contains(refusal("", "a.obj"), "no visible triangles"));
}

TEST_CASE("invisible faces are left out and counted") {
  const std::string more = square + "v nan 0 0\nv inf 0 0\nv 1e999 0 0\nv 1e-999 0 1\nv 0.5 0 0\n";
  const ImportedScene scene =
      import_sound(more + "f 1 2 3\nf 1 2 5\nf 1 2 6\nf 1 2 7\nf 1 2 2\nf 1 9 2\nf 1 2\nf 1 2 8\n", "a.obj",
                   {.smooth = 0.0});
  CHECK(scene.meshes[0].triangles.size() == 2);  // the first and the last: 1e-999 is 0
  CHECK(warns(scene, "3 faces with coordinates that are not finite were left out"));
  CHECK(warns(scene, "3 faces without area were left out"));
  CHECK(scene.meshes[0].positions.size() == 4);  // the positions of unused vertices are gone
}

TEST_CASE("unusable normals are replaced by the face's normal") {
  const ImportedScene scene = import_sound(
      square + "vn 0 0 5\nvn 0 0 0\nvn 0 0 -1\nvn nan 0 0\nf 1//1 2//2 3//3\nf 1//1 3//4 4//1\n", "a.obj");
  CHECK(warns(scene, "3 corners whose normals"));
  CHECK(scene.meshes[0].positions.size() == 5);  // 1 and 4 as written, three with the face's normal
}

TEST_CASE("each material has its mesh, and its .mtl is read") {
  const Folder folder;
  folder.write("parts/colors.mtl",
               "newmtl red\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 100\nillum 2\n"
               "newmtl steel\nKd 0 0 0\nKs 0.9 0.9 0.8\nillum 3\nnewmtl glass\nillum 4\nNi 1.33\n"
               "newmtl dim\nKd 2 -1 nan\nd 0.5\nmap_bump bumps.png\nmap_Kd missing.png\n");
  const std::string file = folder.write(
      "a.obj", square +
                   "mtllib parts/colors.mtl\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl steel \nf 1 3 4\n"
                   "usemtl glass\nf 2 3 4\nusemtl dim\nf 1 2 4\nusemtl who\nf 1 2 3\nusemtl red\nf 1 3 4\n");
  const ImportedScene scene = import_file(file);
  CHECK(broken_promise(scene) == "");
  REQUIRE(scene.materials.size() == 4);
  CHECK(scene.instances.size() == 6);
  CHECK(scene.meshes[1].triangles.size() == 2);  // both stretches of red
  CHECK(scene.meshes[1].name == file + ": red");
  std::vector<int> materials;
  for (const Instance& instance : scene.instances) materials.push_back(instance.material);
  CHECK(materials == std::vector{-1, 0, 1, 2, 3, -1});

  const ScatteringContext context{Vec2(0), 1, 1, 1};
  CHECK(scene.materials[0]->name == "red");
  CHECK(scene.materials[0]->scattering(context).diffuse == Vec3(1, 0, 0));
  CHECK(scene.materials[0]->scattering(context).specular == Vec3(0.5));
  CHECK(scene.materials[0]->scattering(context).shininess == 100);
  CHECK(scene.materials[1]->scattering(context).reflected == Vec3(0.9, 0.9, 0.8));
  CHECK(scene.materials[2]->medium()->ior == 1.33);
  CHECK(scene.materials[3]->scattering(context).diffuse == Vec3(1, 0, 0));
  CHECK(warns(scene, "1 of its materials is not defined, such as `who`"));
  REQUIRE(scene.materials[3]->mask);
  CHECK(scene.materials[3]->mask->blends);
  CHECK(warns(scene, "a picture was left out: cannot read"));
  CHECK(scene.files.size() == 4);
}

TEST_CASE("vertices have colours, with or without a weight before them; vertices without one are white") {
  const ImportedScene scene = import_sound(
      "v 0 0 0\nv 1 0 0 1 0.5 0\nv 1 1 0 1 0 7 nan\nv 0 1 0 1 0.25 0.5 0.75\nf 1 2 3 4\n", "a.obj");
  const std::vector<Vec3>& colors = scene.meshes[0].colors;
  REQUIRE(colors.size() == 4);
  CHECK(colors[0] == Vec3(1));
  CHECK(colors[1].y == doctest::Approx(0.2140).epsilon(1e-3));
  CHECK(colors[2] == Vec3(0, 1, 0));
  CHECK(colors[3].x == doctest::Approx(0.0509).epsilon(1e-2));
  CHECK(scene.warnings.empty());
}

TEST_CASE("text in UTF-16 is refused by name") {
  for (const std::string start : {"\xff\xfe", "\xfe\xff"})
    CHECK(refusal(start + "v", "a.obj") == "a.obj: error: it is text in UTF-16: save it as UTF-8");
}

TEST_CASE("materials outside the folder tree are not read") {
  const Folder folder;
  folder.write("red.mtl", "newmtl red\nKd 1 0 0\n");
  std::filesystem::create_directory(folder.path() / "in");
  std::filesystem::create_symlink(folder / "red.mtl", folder / "in/link.mtl");
  for (const std::string& name : {std::string("../red.mtl"), folder / "red.mtl", std::string("link.mtl"),
                                  std::string("..\\red.mtl"), std::string("in/../../red.mtl")}) {
    CAPTURE(name);
    const std::string file = folder.write("in/a.obj", square + "mtllib " + name + "\nusemtl red\nf 1 2 3\n");
    const ImportedScene refused = import_file(file);
    CHECK(refused.materials.empty());
    CHECK(warns(refused, "lies outside the file's folder; --allow-path DIR allows other ones"));
    CHECK(import_file(file, {}, std::array{folder.path()}).materials.size() == 1);
  }
}

TEST_CASE("pictures of .mtl files are textures") {
  const Folder folder;
  std::filesystem::copy_file("tests/image/pictures/rgb.png", folder / "rgb.png");
  folder.write("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd rgb.png\n");
  const ImportedScene scene =
      import_file(folder.write("a.obj", square + "mtllib a.mtl\nusemtl m\nf 1 2 3\n"));
  CHECK(scene.warnings.empty());
  CHECK(scene.files.back() == folder / "rgb.png");
}

namespace {

// A square whose material has these statements; `folder` has its pictures.
ImportedScene square_of(const Folder& folder, const std::string& statements) {
  folder.write("a.mtl", "newmtl m\n" + statements + "\n");
  ImportedScene scene = import_file(folder.write(
      "a.obj", square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nmtllib a.mtl\nusemtl m\nf 1/1 2/2 3/3 4/4\n"));
  REQUIRE(scene.materials.size() == 1);
  return scene;
}

}  // namespace

TEST_CASE("values of a .mtl file that do not count are named") {
  const Folder folder;
  for (const auto& [statements, warning] : {
           std::pair("illum 4\nNi 1.5\nTf 1 0.5 0.5", "the tint (Tf) of glass"),
           {"illum 6\nNi 1.5\nKd 0.2 0.6 0.3", "the colour (Kd) of glass"},
           {"illum 4\nNi 1.5\nd 0.5", "the transparency (d) of glass"},
           {"illum 9\nNi 1.5\nPr 0.5", "the values and maps Pr, Pm, Pc and Ps of glass"},
           {"illum 9\nNi 1.5\nmap_Kd x.png", "pictures (map_Kd) of glass"},
           {"map_Pc x.png\nmap_Tr x.png\nmap_RMA x.png\ndecal x.png\nmap_aat on",
            "statements that eyeray does not know (decal, map_Pc, map_RMA, map_Tr)"},
           {"anisor 1", "anisotropy (aniso, anisor) without Pr, Pm, Pc or Ps"},
           {"map_Ka x.png", "maps of ambient light (map_Ka)"},
           {"Kd spectral x.rfl", "colours by `spectral`: write Kd with three numbers, R G B"},
           {"Kd xyz 0.4 0.2 0.1", "colours by `xyz`"},
       }) {
    const std::string text = statements, words = warning;
    CAPTURE(text);
    CHECK(warns(square_of(folder, text), "left out: " + words));
  }
  CHECK(square_of(folder, "illum 4\nNi 1.5\nKd 0 0 0\nTf 1 1 1").warnings.empty());
}

TEST_CASE("lines may end with CR alone, and a .mtl file in UTF-16 is named") {
  const Folder folder;
  folder.write("a.mtl", "newmtl m\rKd 1 0 0\r");
  std::string text = square + "mtllib a.mtl\nusemtl m\nf 1 2 3\n";
  std::ranges::replace(text, '\n', '\r');
  const ImportedScene scene = import_file(folder.write("a.obj", text));
  CHECK(scene.warnings.empty());
  CHECK(scene.materials.size() == 1);
  folder.write("a.mtl", "\xff\xfen");
  CHECK(warns(import_file(folder / "a.obj"), "a.mtl is text in UTF-16: save it as UTF-8"));
}

TEST_CASE("an index of 1 makes no glass") {
  const Folder folder;
  CHECK(!square_of(folder, "Kd 1 0 0\nillum 4\nTf 1.00 1.00 1.00\nNi 1.00").materials[0]->medium());
  CHECK(!square_of(folder, "Kd 1 0 0\nillum 7").materials[0]->medium());
  CHECK(square_of(folder, "illum 4\nNi 1.45").materials[0]->medium()->ior == 1.45);
  CHECK(square_of(folder, "illum 4\nNi 5").materials[0]->medium()->ior == 1.5);
  for (const std::string quarter :
       {"illum 9\nd 0.25\nNi 1.0", "illum 4\nd 0.25\nTf .5 .5 .5\nNi 1", "illum 4\nd -halo 0.25"}) {
    const ImportedScene scene = square_of(folder, "Kd 1 0 0\n" + quarter);
    CHECK(!scene.materials[0]->medium());
    REQUIRE(scene.materials[0]->mask);
    CHECK(scene.materials[0]->mask->alpha->alpha_at(Vec2(0)) == 0.25);
    CHECK(warns(scene, "the halo of transparency (d -halo)") == contains(quarter, "halo"));
  }
}

TEST_CASE("a byte order mark before OBJ, MTL and PLY is skipped") {
  const std::string mark = "\xef\xbb\xbf";
  const Folder folder;
  folder.write("a.mtl", mark + "newmtl m\nKd 1 0 0\n");
  const ImportedScene scene =
      import_file(folder.write("a.obj", mark + square + "mtllib a.mtl\nusemtl m\nf 1 2 3\n"));
  CHECK(scene.warnings.empty());
  CHECK(scene.materials.size() == 1);
  CHECK(scene.meshes[0].triangles.size() == 1);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(import_sound(mark + ply, "a.ply").meshes[0].triangles.size() == 1);
}

TEST_CASE("options of maps may omit numbers; -s and -o transform the picture") {
  const Folder folder;
  std::filesystem::copy_file("tests/image/pictures/rgb.png", folder / "my picture.png");
  const auto corner = [&](const std::string& options) {
    CAPTURE(options);
    const ImportedScene scene = square_of(folder, "map_Kd " + options + " my picture.png");
    CHECK(scene.warnings.empty());
    CHECK(scene.files.back() == folder / "my picture.png");
    return scene.meshes[0].uv[2];  // the uv of the corner (1, 1)
  };
  CHECK(corner("") == Vec2(1));
  CHECK(corner("-s 2") == Vec2(2, 1));
  CHECK(corner("-s 2 3") == Vec2(2, 3));
  CHECK(corner("-s -2 3 1 -o 0.5 -clamp on") == Vec2(-1.5, 3));
  CHECK(corner("-mm 0 -o .25 -1e0 -t 0 0 -blendu on -clamp off") == Vec2(1.25, 0));
  for (const std::string option :
       {"-mm 0.5 0.5", "-imfchan r", "-t 0.1", "-boost 2", "-bm 0.5", "-texres 512 512", "-type sphere",
        "-cc on", "-blendv off", "-colorspace linear"})
    for (const std::string name : {"my picture.png", "\"my picture.png\""}) {
      const ImportedScene scene =
          square_of(folder, "map_Kd -s 2 " + option + " " + name + "\nbump -s 2 -bm 3 my picture.png");
      CHECK(scene.warnings == std::vector<std::string>{
                                  "left out: the option " + option.substr(0, option.find(' ')) + " of maps",
                                  "left out: bump maps that are neither grey nor normal maps"});
      CHECK(scene.meshes[0].uv[2] == Vec2(2, 1));
      CHECK(scene.files.back() == folder / "my picture.png");
    }
  CHECK(warns(square_of(folder, "map_Kd -s 2 my picture.png\nmap_d my picture.png"), "that differ"));
}

TEST_CASE(
    "map_d cuts out or blends, d = 0 hides, d = 0.5 blends, Ke emits, and Pr, Pm make a principled "
    "material") {
  const Folder folder;
  std::filesystem::copy_file("tests/image/pictures/rgb.png", folder / "rgb.png");
  const ImportedScene cut = square_of(folder, "map_d rgb.png");
  CHECK(cut.warnings.empty());
  REQUIRE(cut.materials[0]->mask);
  CHECK(cut.materials[0]->mask->alpha->alpha_at(Vec2(0.5)) < 1);
  CHECK(!square_of(folder, "d 0").materials[0]->mask->covers(Vec2(0)));
  CHECK(cut.materials[0]->mask->blends);  // its picture is grey at some points
  for (const std::string half : {"d 0.5", "Tr 0.5", "illum 2\nd 0.5"}) {
    const ImportedScene blended = square_of(folder, half);
    CHECK(blended.warnings.empty());
    REQUIRE(blended.materials[0]->mask);
    CHECK(blended.materials[0]->mask->blends);
    CHECK(blended.materials[0]->mask->alpha->alpha_at(Vec2(0)) == 0.5);
  }
  CHECK_FALSE(square_of(folder, "d 1").materials[0]->mask);

  const ScatteringContext context{Vec2(0), 1, 1, 1};
  CHECK(square_of(folder, "Ke 2 0 7e9").materials[0]->scattering(context).emitted == Vec3(2, 0, 1e6));
  CHECK(square_of(folder, "map_Ke rgb.png").materials[0]->scattering(context).emitted != Vec3(0));
  const ImportedScene metal = square_of(folder, "Kd 1 0.5 0\nPr 0.2\nPm 1\naniso 0.5\nanisor 0.25");
  CHECK(metal.warnings.empty());
  REQUIRE(metal.materials[0]->rough_axis);
  CHECK(metal.materials[0]->rough_axis->turn == doctest::Approx(M_PI / 2));
  const Bsdf brushed = metal.materials[0]->bsdf(context, metal.materials[0]->scattering(context));
  CHECK(brushed.widths.x == doctest::Approx(0.04 + 0.96 * 0.25));
  CHECK(brushed.widths.y == doctest::Approx(0.04));
  CHECK(!metal.materials[0]->emits());
}

TEST_CASE("maps of roughness, metalness and sheen multiply their values; a bluish bump map is a normal map") {
  const Folder folder;
  const auto write = [&](const char* name, const Vec3& color) {
    image::Image picture(2, 2, 3);
    for (size_t i = 0; i < picture.samples().size(); ++i) picture.samples()[i] = float(color[int(i % 3)]);
    image::write_image(folder / name, picture);
  };
  write("white.png", Vec3(1));
  write("black.png", Vec3(0));
  write("grey.png", Vec3(0.2));
  write("blue.png", Vec3(0.2140, 0.2140, 1));  // 128, 128, 255

  // White metal reflects all light, and has no diffuse colour.
  const ScatteringContext context{Vec2(0.5), 1, 1, 1};
  const auto diffuse = [&](const std::string& statements) {
    const ImportedScene scene = square_of(folder, "Kd 1 1 1\n" + statements);
    CHECK(scene.warnings.empty());
    return scene.materials[0]->scattering(context).diffuse.x;
  };
  CHECK(diffuse("map_Pm white.png") == diffuse("Pm 1"));
  CHECK(diffuse("Pm 0.5\nmap_Pm white.png") == diffuse("Pm 0.5"));
  CHECK(diffuse("Pr 0.5\nmap_Pm black.png") == diffuse("Pr 0.5"));
  CHECK(diffuse("Pm 1") < diffuse("Pm 0.5"));
  for (const char* map : {"map_Pr grey.png", "map_Ps grey.png"}) {
    const ImportedScene scene = square_of(folder, map);
    CHECK(scene.warnings.empty());
    CHECK(scene.files.back() == folder / "grey.png");
  }

  for (const char* bump : {"map_Bump -bm 1 blue.png", "bump blue.png", "norm blue.png"})
    CHECK(square_of(folder, bump).materials[0]->normal_map);
  CHECK(warns(square_of(folder, "norm blue.png\nbump blue.png"), "left out: bump maps beside normal maps"));
}

TEST_CASE("a grey bump map becomes the normal map of its slopes, which -bm multiplies") {
  const Folder folder;
  // 10 codes higher at each step to the right, and 20 at each step up.
  image::Image ramp(8, 4, 3);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 8; ++column)
      for (int i = 0; i < 3; ++i)
        ramp.samples()[size_t(3 * (8 * row + column) + i)] =
            float(image::linear_from_srgb((10 * column + 20 * (3 - row)) / 255.0));
  image::write_image(folder / "ramp.png", ramp);
  const auto normal = [&](const std::string& statement, const Vec2& uv) {
    const ImportedScene scene = square_of(folder, statement + " ramp.png");
    CHECK(scene.warnings.empty());
    REQUIRE(scene.materials[0]->normal_map);
    return glm::normalize(scene.materials[0]->normal_map->texture->at(uv) * 2.0 - 1.0);
  };
  const Vec2 inside(0.5625, 0.625);  // a texel's middle, with neighbours on all sides
  for (const auto& row : {std::pair("bump", 1.0),
                          {"map_Bump -bm 3", 3.0},
                          {"map_bump -bm -5", -5.0},
                          {"bump -clamp on -bm 2", 2.0}}) {
    const char* const statement = row.first;
    const double strength = row.second;
    CAPTURE(statement);
    const Vec3 wanted = glm::normalize(Vec3(-strength * 10 / 255, -strength * 20 / 255, 1));
    CHECK(glm::length(normal(statement, inside) - wanted) < 0.01);
  }
  // A clamped picture is flat along u beyond its edge; a repeated one falls back to its other side.
  CHECK(normal("bump -clamp on -bm 4", {0.9375, 0.625}).x == doctest::Approx(-4 * 5 / 255.0).epsilon(0.15));
  CHECK(normal("bump -bm 4", {0.9375, 0.625}).x > 0.3);
}
