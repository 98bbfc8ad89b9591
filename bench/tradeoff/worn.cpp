#include "worn.hpp"

#include <bodice/tryon/wearing.hpp>

#include "must.hpp"

namespace tradeoff {

bodice::tryon::WornGarment cut_for(const bodice::engine::Context& context, const Subject& subject,
                                   const GarmentChoice& choice, double edge_m) {
  auto cut = must(
      bodice::tryon::make_garment(context, subject.skin, {.kind = choice.kind, .edge_length_m = edge_m}));
  cut.name = choice.name;
  return cut;
}

}  // namespace tradeoff
