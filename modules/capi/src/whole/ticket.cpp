// Skins and proxies made beside the frames.
#include <atomic>
#include <cstdio>
#include <thread>

#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/proxy.hpp"
#include "whole/fit.hpp"
#include "whole/skin.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

struct bodice_ticket {
  bodice_ticket(capi::SharedContext shared, const bodice_skin_options& options)
      : context(std::move(shared)), progress(context->engine_context(), options.progress, options.host) {}
  ~bodice_ticket() {
    progress.cancel();
    wait();
  }
  void wait() {
    if (thread.joinable()) thread.join();
  }
  /// Runs on the ticket's thread.
  void work(capi::HostBody body, const fitting::FitOptions& options, bool bind) noexcept {
    status = capi::guarded([&]() -> Outcome {
      BODICE_CHECK(capi::make_skin(progress.context(), progress, std::move(body), skin));
      return capi::make_fit(progress, skin, options, bind, fitted);
    });
    if (status != BODICE_OK) std::snprintf(sentence, sizeof sentence, "%s", bodice_last_error());
    done = true;
  }

  capi::SharedContext context;
  capi::Progress progress;
  tryon::SegmentedSkin skin;
  capi::Fitted fitted;
  bodice_status status = BODICE_OK;
  char sentence[1024] = {};  // a string might find no memory, like the work before it
  std::atomic<bool> done{false};
  bool taken = false;
  std::thread thread;
};

bodice_status bodice_fit_begin(const bodice_context* context, const bodice_mesh* mesh,
                               const bodice_skin_options* given_skin, const bodice_fit_options* given_fit,
                               bodice_ticket** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the ticket"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    bodice_skin_options skin_options;
    bodice_fit_options fit_options;
    BODICE_CHECK(capi::read(given_skin, skin_options, true));
    BODICE_CHECK(capi::read(given_fit, fit_options, true));
    capi::HostBody body;
    fitting::FitOptions wanted;
    BODICE_CHECK(capi::read_body(mesh, skin_options, body));
    BODICE_CHECK(capi::read_fit(fit_options, wanted));
    auto ticket = std::make_unique<bodice_ticket>(context->state, skin_options);
    ticket->thread =
        std::thread([state = ticket.get(), body = std::move(body), wanted = std::move(wanted),
                     bind = fit_options.bind != 0]() mutable { state->work(std::move(body), wanted, bind); });
    *out = ticket.release();
    return {};
  });
}

bodice_status bodice_ticket_poll(const bodice_ticket* ticket, int32_t* done) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(ticket, "The ticket"));
    if (!done) return invalid("The pointer to done is null.", "Pass one.");
    *done = ticket->done ? 1 : 0;
    return {};
  });
}

bodice_status bodice_ticket_cancel(const bodice_ticket* ticket) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(ticket, "The ticket"));
    const_cast<bodice_ticket*>(ticket)->progress.cancel();
    return {};
  });
}

bodice_status bodice_ticket_take(bodice_ticket* ticket, bodice_skin** skin, bodice_proxy** proxy,
                                 bodice_fit_report* report) {
  return capi::guarded([&]() -> Outcome {
    if (skin) *skin = nullptr;
    BODICE_CHECK(capi::begin_result(proxy, "the proxy"));
    BODICE_CHECK(capi::check_handle(ticket, "The ticket"));
    BODICE_CHECK(capi::write(capi::with_defaults<bodice_fit_report>(), report, true));
    if (ticket->taken) return invalid("The results of this ticket were taken.", "Begin another fit.");
    ticket->wait();
    if (ticket->status != BODICE_OK) return {ticket->status, ticket->sentence};
    // The ticket keeps its results until both handles are made, so that a call without memory can be
    // repeated.
    auto made_proxy = std::make_unique<bodice_proxy>(ticket->context, *ticket->fitted.proxy);
    auto made_skin = skin ? std::make_unique<bodice_skin>(ticket->context, ticket->skin) : nullptr;
    if (skin) *skin = made_skin.release();
    *proxy = made_proxy.release();
    ticket->taken = true;
    return capi::write(ticket->fitted.report, report, true);
  });
}

void bodice_ticket_destroy(bodice_ticket* ticket) {
  delete ticket;
}
