#ifndef BODICE_WITH_JSON
namespace bodice::inline v0_1::proxy {

engine::Result<BodyProxy> from_json(std::string_view) {
  return engine::Error{
      engine::ErrorCode::kUnreadable, "These bytes are no proxy in the binary form.",
      "Compile bodice_frame.cpp with -DBODICE_WITH_JSON for JSON, or write the proxy with -o FILE.bodice."};
}

std::string to_json(const BodyProxy&) {
  throw std::runtime_error("this build writes no JSON");
}

}  // namespace bodice::proxy
#endif
