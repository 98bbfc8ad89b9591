// Finds the pieces of a file that make up one body together.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>

#include "import/body/piece.hpp"

namespace bodice::inline v0_1::io {

/// Whether most of a piece's area lies in a few planes, as that of furniture and rooms does.
bool is_flat_sided(const JoinedScene& joined, const Piece& piece);
/// Whether a piece is a floor, a wall or a card.
bool is_flat(const Piece& piece);
/// Whether a piece has more area than a body of its size, as a room does.
bool is_room(const Piece& piece);
/// Whether a piece is closed like the skin of a body.
bool is_closed(const Piece& piece);

/// The pieces that make up a body with `seed`, which is the first of them. A closed seed takes limbs, and
/// legs that exist only as trousers; an open one takes all that is near it, since patches of a scan have no
/// other order. Indices into `pieces`.
std::vector<std::size_t> join_pieces(const engine::Context& context, const JoinedScene& joined,
                                     const std::vector<Piece>& pieces, std::size_t seed);

/// The closed pieces of a body's size beside the body: other people. Indices into `pieces`.
std::vector<std::size_t> other_people(const engine::Context& context, const JoinedScene& joined,
                                      const std::vector<Piece>& pieces, const std::vector<std::size_t>& body);

}  // namespace bodice::io
