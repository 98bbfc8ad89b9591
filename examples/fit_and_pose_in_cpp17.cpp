// A body becomes a proxy, which is saved, loaded and moved by bones, in C++17; the log is the host's.
//
//    body --fit--> proxy --to bytes--> file --from bytes--> proxy --pose(matrices)--> particles outside
//
//     fit_and_pose_in_cpp17 [body.obj]
#include <cstdio>
#include <vector>

#include <bodice.hpp>

namespace {

int failed() {
  std::puts(bodice_last_error());
  return 1;
}

std::vector<unsigned char> bytes_of(const bodice::Proxy& proxy) {
  std::size_t size = 0;
  bodice_proxy_to_bytes(proxy.get(), BODICE_BINARY, nullptr, 0, &size);
  std::vector<unsigned char> bytes(size);
  bodice_proxy_to_bytes(proxy.get(), BODICE_BINARY, bytes.data(), bytes.size(), &size);
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  bodice_context_options options = bodice_default_context_options();
  options.workers = 0;  // all that the machine has
  options.log_level = BODICE_WARNING;
  options.log = [](void*, std::int32_t, const char* line) { std::printf("log: %s\n", line); };
  auto context = bodice::Context::create(options);
  if (!context) return failed();

  bodice_skin_options skin_options = bodice_default_skin_options();
  skin_options.find_rig = 1;  // or skin_options.rig: bones of your own
  bodice_skin* made = nullptr;
  const bodice_status status = argc > 1 ? bodice_skin_from_file(context->get(), argv[1], &skin_options, &made)
                                        : bodice_skin_built_in(context->get(), 1, 1.68, &skin_options, &made);
  if (status != BODICE_OK) return failed();
  const bodice::Skin skin(made);
  bodice_fit_options fit_options = bodice_default_fit_options();
  fit_options.tier = BODICE_SOLID;  // a tenth of a second; the default is finer
  auto fitted = skin.fit(*context, fit_options);
  if (!fitted) return failed();

  const std::vector<unsigned char> bytes = bytes_of(*fitted);  // what a file would hold
  auto proxy = bodice::Proxy::from_bytes(*context, bytes.data(), bytes.size());
  if (!proxy) return failed();
  auto collider = bodice::Collider::create(*context, *proxy);
  auto workspace = bodice::Workspace::create(*context);
  const auto info = proxy->info();
  if (!collider || !workspace || !info) return failed();

  // The host's bones: here the bind pose, which moves forward by a millimeter a frame.
  std::vector<float> bones(12 * std::size_t{info->joints});
  for (std::uint32_t joint = 0; joint < info->joints; ++joint) {
    double rest[12];
    bodice_proxy_get_bind(proxy->get(), joint, rest);
    for (std::size_t k = 0; k < 12; ++k) bones[12 * joint + k] = static_cast<float>(rest[k]);
  }
  std::vector<double> drop = {0.0, 1.2, 0.0};  // in the chest
  bodice::Particles particles(1);
  particles.position(drop.data());
  std::uint64_t contacts = 0;
  for (int frame = 0; frame < 30; ++frame) {
    for (std::size_t joint = 0; joint < info->joints; ++joint) bones[12 * joint + 11] += 0.001f;
    if (collider->pose(bones.data(), info->joints, BODICE_ROWS_3X4, 1.0 / 60.0) != BODICE_OK) return failed();
    const auto report = collider->resolve(particles, *workspace);
    if (!report) return failed();
    contacts += report->contacts;
  }
  bodice_contact contact;
  if (bodice_query_point(collider->get(), drop.data(), &contact) != BODICE_OK) return failed();
  std::printf("%zu bytes, %u joints; the particle left the chest and is %.1f mm from the body\n",
              bytes.size(), info->joints, 1e3 * double{contact.distance});
  return contacts > 0 && contact.distance > -1e-4f ? 0 : 1;
}
