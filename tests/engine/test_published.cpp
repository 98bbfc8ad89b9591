#include <doctest/doctest.h>

#include <memory>
#include <thread>

#include <bodice/engine/published.hpp>

using namespace bodice::engine;

TEST_CASE("a value is seen only from the boundary on, and the latest offer wins") {
  Published<int> published;
  CHECK(published.current() == nullptr);
  CHECK(!published.advance());
  published.publish(std::make_shared<const int>(1));
  CHECK(published.current() == nullptr);
  published.publish(std::make_shared<const int>(2));
  CHECK(published.advance());
  CHECK(*published.current() == 2);
  CHECK(!published.advance());
  CHECK(*published.share() == 2);
}

TEST_CASE("the frame thread frees nothing: a dropped value lives until the next publication") {
  Published<int> published;
  auto first = std::make_shared<const int>(1);
  std::weak_ptr<const int> watch = first;
  published.publish(std::move(first));
  published.advance();
  published.publish(std::make_shared<const int>(2));
  published.advance();
  CHECK(!watch.expired());
  published.publish(std::make_shared<const int>(3));
  CHECK(watch.expired());
}

TEST_CASE("publishers race with boundaries: every value seen is whole and newer than the last") {
  struct Pair {
    int a, b;
  };
  Published<Pair> published;
  constexpr int kLast = 20'000;
  std::thread publisher([&] {
    for (int i = 1; i <= kLast; ++i) published.publish(std::make_shared<const Pair>(Pair{i, -i}));
  });
  int seen = 0;
  bool in_order = true;
  while (seen < kLast) {
    if (!published.advance()) continue;
    const Pair& now = *published.current();
    in_order = in_order && now.a > seen && now.a == -now.b;
    seen = now.a;
  }
  publisher.join();
  CHECK(in_order);
}
