// Named tasks that pass typed data to one another: built once, run many times.
//
//     // Field compute_field(const Context&, const TriMesh&);
//     // Result<Proxy> fit_parts(const Context&, const TriMesh&, const Field&);  the graph unwraps it
//     GraphBuilder builder;
//     auto skin = builder.input<TriMesh>("skin");
//     auto field = builder.add("geodesic", compute_field, skin);
//     auto proxy = builder.add("fit", fit_parts, skin, field);
//     auto graph = std::move(builder).build();  // or an error that names the tasks
//     graph->set(skin, mesh);
//     if (graph->run(context)) use(graph->get(proxy));
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/function_ref.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

class GraphBuilder;
class TaskGraph;

/// A handle to a task's result, or to an input of the graph.
template <class T>
class Output {
 public:
  Output() = default;

 private:
  friend class GraphBuilder;
  friend class TaskGraph;
  struct Slot {
    std::optional<T> value;
  };
  std::uint32_t node_ = 0;
  std::shared_ptr<Slot> slot_;
};

/// Stands for the result of a task that returns nothing.
struct Done {};

namespace detail {

/// The type of the data that a task gives which returns a T.
template <class T>
struct Unwrapped {
  using type = T;
};
/// A task that returns nothing gives Done.
template <>
struct Unwrapped<void> {
  using type = Done;
};
/// A task that returns a Result gives its value.
template <class T>
struct Unwrapped<Result<T>> {
  using type = T;
};
/// A task that returns a Result without a value gives Done.
template <>
struct Unwrapped<Result<void>> {
  using type = Done;
};

using TaskBody = std::function<Result<void>(const Context&)>;

/// A task or input of a graph.
struct GraphNode {
  std::string name;
  TaskBody body;  // empty for an input, and for a task that is declared but not defined
  bool is_input = false;
  int priority = 0;
  std::vector<std::uint32_t> needs;
  std::shared_ptr<void> slot;
};

}  // namespace detail

/// The type of the Output of a task with signature F(const Context&, const In&...).
template <class F, class... In>
using TaskResult = typename detail::Unwrapped<std::invoke_result_t<F&, const Context&, const In&...>>::type;

/// Collects tasks. Nothing is checked before build(), so that tasks can be declared in any order.
class GraphBuilder {
 public:
  GraphBuilder();
  ~GraphBuilder();
  GraphBuilder(GraphBuilder&&) noexcept;
  GraphBuilder& operator=(GraphBuilder&&) noexcept;

  /// Adds a value that the caller sets before each run in which it changes.
  template <class T>
  Output<T> input(std::string name) {
    return add_output<T>(std::move(name), true);
  }

  /// Adds a task that define() fills in later.
  template <class T>
  Output<T> declare(std::string name) {
    return add_output<T>(std::move(name), false);
  }

  /// Adds a task: `function(context, inputs...)` takes its inputs by const reference and returns its result
  /// by value. A Result is unwrapped, and its error ends the run; a task that returns nothing gives Done.
  template <class F, class... In>
  Output<TaskResult<F, In...>> add(std::string name, F function, const Output<In>&... inputs) {
    auto output = declare<TaskResult<F, In...>>(std::move(name));
    define(output, std::move(function), inputs...);
    return output;
  }

  /// Adds a task that writes into a value kept between runs, so that its memory is reused: `function(context,
  /// value, inputs...)`. T is default-constructed once.
  template <class T, class F, class... In>
  Output<T> add_into(std::string name, F function, const Output<In>&... inputs) {
    auto output = declare<T>(std::move(name));
    set_body(output.node_, output.slot_,
             [function = std::move(function), out = output.slot_,
              ... in = inputs.slot_](const Context& context) mutable -> Result<void> {
               if (!out->value) out->value.emplace();
               return finish([&] { return function(context, *out->value, *in->value...); });
             });
    (need(output.node_, inputs.node_, inputs.slot_), ...);
    return output;
  }

  /// Fills in a task that declare() added. `function` is as in add().
  template <class T, class F, class... In>
  void define(const Output<T>& output, F function, const Output<In>&... inputs) {
    set_body(output.node_, output.slot_,
             [function = std::move(function), out = output.slot_,
              ... in = inputs.slot_](const Context& context) mutable -> Result<void> {
               return store(*out, [&] { return function(context, *in->value...); });
             });
    (need(output.node_, inputs.node_, inputs.slot_), ...);
  }

  /// Makes `later` start after `earlier` has ended, without taking its result.
  template <class A, class B>
  void order(const Output<A>& earlier, const Output<B>& later) {
    need(later.node_, earlier.node_, earlier.slot_);
  }

  /// Sets a priority (0 unless set): ready tasks of higher priority start first.
  template <class T>
  void set_priority(const Output<T>& output, int priority) {
    set_node_priority(output.node_, priority);
  }

  /// Fails with kInvalidArgument, naming the tasks: two of one name, a task declared but not defined or
  /// defined twice, an input of another graph, a cycle.
  Result<TaskGraph> build() &&;

 private:
  template <class T>
  Output<T> add_output(std::string name, bool is_input) {
    Output<T> output;
    output.slot_ = std::make_shared<typename Output<T>::Slot>();
    output.node_ = add_node(std::move(name), is_input, output.slot_);
    return output;
  }
  template <class Call>
  static Result<void> finish(Call&& call) {
    if constexpr (std::is_same_v<std::invoke_result_t<Call>, Result<void>>) {
      return call();
    } else {
      call();
      return {};
    }
  }
  template <class Slot, class Call>
  static Result<void> store(Slot& slot, Call&& call) {
    using Returned = std::invoke_result_t<Call>;
    if constexpr (std::is_void_v<Returned>) {
      call();
      slot.value.emplace();
    } else if constexpr (std::is_same_v<Returned, Result<void>>) {
      if (auto result = call(); !result) return result.error();
      slot.value.emplace();
    } else if constexpr (!std::is_same_v<typename detail::Unwrapped<Returned>::type, Returned>) {
      auto result = call();
      if (!result) return std::move(result).error();
      slot.value.emplace(std::move(result).value());
    } else {
      slot.value.emplace(call());
    }
    return {};
  }

  std::uint32_t add_node(std::string name, bool is_input, std::shared_ptr<void> slot);
  void set_body(std::uint32_t node, const std::shared_ptr<void>& slot, detail::TaskBody body);
  void need(std::uint32_t node, std::uint32_t needed, const std::shared_ptr<void>& slot);
  void set_node_priority(std::uint32_t node, int priority);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Called after each task, one call at a time and with `ended` rising, on the thread that ran the task.
struct Progress {
  std::size_t ended = 0, total = 0;
  std::string_view task;
};
using OnProgress = FunctionRef<void(const Progress&)>;

/// A checked graph. It has one run at a time, in which the engine itself allocates nothing.
class TaskGraph {
 public:
  ~TaskGraph();
  TaskGraph(TaskGraph&&) noexcept;
  TaskGraph& operator=(TaskGraph&&) noexcept;

  /// Sets an input, for all runs until it is set again.
  template <class T>
  void set(const Output<T>& input, T value) {
    input.slot_->value.emplace(std::move(value));
    mark_set(input.node_, input.slot_);
  }

  /// Runs every task once, each as soon as its inputs are there, and traces each under its name.
  /// Fails with kInvalidArgument if an input was never set, with kCanceled, or with the error of the
  /// failed task that comes first in topological order; rethrows an exception of a task by the same rule.
  /// Which error is reported does not depend on timing.
  Result<void> run(const Context& context);
  /// The same, and calls on_progress after each task.
  Result<void> run(const Context& context, OnProgress on_progress);

  /// The result of a task if it ended in the last run, else null, so that a stopped run never shows results
  /// of an earlier one.
  template <class T>
  const T* find(const Output<T>& output) const {
    return ended(output.node_, output.slot_) ? &*output.slot_->value : nullptr;
  }
  /// Precondition: the last run succeeded.
  template <class T>
  const T& get(const Output<T>& output) const {
    return *output.slot_->value;
  }

  /// Moves the result out of the graph, which no longer has it. Precondition: as of get().
  template <class T>
  T take(const Output<T>& output) {
    mark_taken(output.node_, output.slot_);
    return std::move(*output.slot_->value);
  }

  /// The number of tasks; inputs do not count.
  std::size_t size() const;
  /// The graph in the DOT language: inputs are boxes, edges run with the data.
  std::string dump_dot() const;

 private:
  friend class GraphBuilder;
  struct Impl;
  explicit TaskGraph(std::unique_ptr<Impl> impl);
  void mark_set(std::uint32_t node, const std::shared_ptr<void>& slot);
  void mark_taken(std::uint32_t node, const std::shared_ptr<void>& slot);
  bool ended(std::uint32_t node, const std::shared_ptr<void>& slot) const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::engine
