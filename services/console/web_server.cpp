#include "services/console/web_server.h"

#include "services/console/web_hub.h"

namespace prospect::services::console {

WebServer::WebServer(const WebOptions& options, const PageFiles& files, Source& source)
    : hub_(std::make_unique<WebHub>(options, files, source)) {}

WebServer::~WebServer() = default;

unsigned short WebServer::port() const { return hub_->port(); }

void WebServer::Notify() { hub_->Notify(); }

void WebServer::Run() { hub_->Run(); }

}  // namespace prospect::services::console
