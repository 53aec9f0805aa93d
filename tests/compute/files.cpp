#include "host/compute/data_file.hpp"
#include "host/compute/kernel_keys.hpp"
#include "host/compute/npy.hpp"
#include "host/core/atomic_file.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("NumPy reads what eyeray writes, and eyeray what NumPy writes") {
  const KernelFolder folder(
      "layout(local_size_x = 1) in; struct S { vec3 p; uint n; };\n"
      "layout(std430, binding = 0) buffer A { mat2x3 a[]; }; layout(std430, binding = 1) buffer B { S b[]; };"
      "layout(std430, binding = 2) buffer C { int c[]; };",
      "", "groups = 3\n[buffer.A]\noutput = \"a.npy\"\n[buffer.B]\noutput = \"b.npy\"\n");
  const compute::Job job = folder.job();
  compute::write_outputs(job, compute::run(job, {}));
  write_text(
      folder.path() / "check.py",
      "import numpy as n, sys\n"
      "a, b = n.load('a.npy'), n.load('b.npy')\n"
      "assert a.shape == (3, 2, 3) and a.dtype == n.float32, a.dtype\n"
      "assert b.shape == (3,) and b['p'].shape == (3, 3) and b['n'].dtype == n.uint32\n"
      "n.save('a2.npy', a * 2); n.save('b2.npy', b); n.save('c.npy', n.array([7, 8], dtype=n.uint32))\n"
      "n.save('f.npy', n.asfortranarray(a)); n.save('d.npy', a.astype(n.float64))\n"
      "n.save('big.npy', a.astype('>f4')); n.save('short.npy', a[:2, :, :2])\n");
  const ProcessResult numpy =
      run_process({"/bin/sh", "-c", "cd " + folder.path().string() + " && exec /usr/bin/python3 check.py"});
  CAPTURE(numpy.err);
  REQUIRE(numpy.code == 0);
  const compute::Job again =
      folder.job({"buffer.A.file=" + (folder / "a2.npy"), "buffer.B.file=" + (folder / "b2.npy"),
                  "buffer.C.file=" + (folder / "c.npy")});
  auto doubled = records<float>(job.buffers[0].bytes);
  const auto read = records<float>(again.buffers[0].bytes);
  REQUIRE(read.size() == doubled.size());
  for (size_t i = 0; i < read.size(); ++i)
    if (i % 4 != 3) CHECK(read[i] == 2 * doubled[i]);
  CHECK(again.buffers[1].bytes == job.buffers[1].bytes);
  CHECK(records<int32_t>(again.buffers[2].bytes) == std::vector<int32_t>{7, 8});

  const auto refused = [&](const std::string& file) {
    return folder.refusal({"buffer.A.file=" + (folder / file)});
  };
  CHECK(contains(refused("f.npy"), "its elements are in Fortran's order"));
  CHECK(contains(refused("d.npy"),
                 "has elements of type '<f8', but the buffer has '<f4': convert the array with "
                 ".astype('<f4')"));
  CHECK(contains(refused("big.npy"), "its numbers are big-endian"));
  CHECK(contains(refused("short.npy"),
                 "has 32 bytes of numbers, but the buffer has 24 bytes of numbers for each"));
  const std::string whole = read_text(folder.path() / "a2.npy");
  for (const size_t length : {0u, 5u, 9u, 11u, 100u}) {
    CAPTURE(length);
    write_text(folder.path() / "cut.npy", whole.substr(0, length));
    CHECK(contains(refused("cut.npy"), "cannot read the array " + (folder / "cut.npy")));
  }
  write_text(folder.path() / "cut.npy", whole.substr(0, whole.size() - 24));
  CHECK(contains(refused("cut.npy"), "and its shape is of another size"));
}

TEST_CASE("pictures, raw bytes and tables are written and read") {
  const KernelFolder folder(
      "layout(local_size_x = 4) in;\nlayout(std430, binding = 0) buffer V { vec3 v[]; };"
      "layout(std430, binding = 1) buffer C { uint c[]; }; layout(std430, binding = 2) buffer F { float f[]; "
      "};",
      "",
      "groups = [2]\n[buffer.V]\noutput=\"v.pfm\"\nwidth=4\n[buffer.C]\noutput=\"c.png\"\nwidth=2\n"
      "noise={from=0,to=4294967295}\n[buffer.F]\noutput=\"f.csv\"\nvalues=[0.5,2]\n");
  const compute::Job job = folder.job();
  compute::write_outputs(job, compute::run(job, {}));
  CHECK(read_text(folder.path() / "f.csv") == "value\n0.5\n2\n");
  const auto same = [&](size_t buffer, const std::string& file, uint32_t mask) {
    compute::TypePtr type = job.buffers[buffer].slot.type;
    const auto read = records<uint32_t>(compute::read_block(folder / file, type));
    const auto written = records<uint32_t>(job.buffers[buffer].bytes);
    REQUIRE(read.size() == written.size());
    for (size_t i = 0; i < read.size(); ++i)
      if (buffer == 1 || i % 4 != 3) CHECK((read[i] & mask) == (written[i] & mask));
  };
  same(0, "v.pfm", UINT32_MAX);
  same(1, "c.png", 0xffffff);
  compute::write_block(folder / "v.bin", *job.buffers[0].type, job.buffers[0].bytes, 0);
  same(0, "v.bin", UINT32_MAX);
  compute::write_block(folder / "v.csv", *job.buffers[0].type, job.buffers[0].bytes, 0);
  CHECK(read_text(folder.path() / "v.csv").starts_with("x,y,z\n"));

  const auto refused = [&](const std::string& override) { return folder.refusal({override}); };
  CHECK(contains(refused("buffer.V.width=3"), "8 elements are no picture of 3 pixels a row"));
  CHECK(contains(refused("buffer.V.output=v.gif"),
                 "its ending must be .npy, .bin, .csv, .png, .pfm, .hdr or .exr"));
  CHECK(contains(refused("buffer.F={file=\"" + (folder / "v.pfm") + "\"}"),
                 "has colours, but a pixel here is one float"));
}

TEST_CASE("docs/kernel-files.md has every key of a kernel file") {
  const std::string page = read_text("docs/kernel-files.md");
  const auto row = [&](std::string_view key) {
    CAPTURE(key);
    const std::string name(key);
    CHECK((contains(page, "| `" + name + "` |") || contains(page, "| `[" + name + "]` |") ||
           contains(page, "| `[" + name + ".NAME]` |") || contains(page, "`" + name + "`,")));
  };
  size_t keys = 0;
  for (const compute::KernelTable& table : compute::kernel_tables()) {
    for (const reading::Key& key : table.keys) row(key.name), ++keys;
    for (const std::string_view key : table.lists) row(key), ++keys;
  }
  CHECK(keys > 30);
}
