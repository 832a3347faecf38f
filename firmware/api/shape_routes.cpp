#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"
#include "firmware/api/shape_mesh.hpp"

namespace traygauge {
namespace {

HttpResponse no_shape(const std::string& id) {
  std::string message = "The shape of scan " + id;
  message += " is not kept: only those of the last trays are, in memory.";
  return error_response(404, "no_shape", message);
}

HttpResponse answer_shape(const HubSite& site, const ScanId& id) {
  std::shared_ptr<const std::string> json = site.shapes.find(id);
  if (json == nullptr) return no_shape(scan_id_text(id));
  HttpResponse response = json_response({});
  response.body = std::move(json);
  return response;
}

HttpResponse answer_mesh(const HubSite& site, const ScanId& id) {
  const std::shared_ptr<const std::string> json = site.shapes.find(id);
  if (json == nullptr) return no_shape(scan_id_text(id));
  const Expected<ReadShape> shape = read_shape(*json);
  if (!shape.ok()) return error_response(500, "shape", shape.failure());
  HttpResponse response;
  response.content_type = "application/octet-stream";
  response.headers = {{"Cache-Control", "no-store"},
                      {"Content-Disposition", "attachment; filename=\"" + scan_id_text(id) + ".ply\""}};
  response.body = compose_shape_mesh(*shape);
  return response;
}

HttpResponse answer_picture(const HubSite& site, const ScanId& id) {
  std::shared_ptr<const std::string> jpeg = site.pictures.find(id);
  if (jpeg == nullptr) {
    std::string message = "There is no picture of scan " + scan_id_text(id);
    message += ": the owner does not show pictures, or it is gone.";
    return error_response(404, "no_picture", message);
  }
  HttpResponse response;
  response.content_type = "image/jpeg";
  response.headers = {{"Cache-Control", "no-store"}};
  response.body = std::move(jpeg);
  return response;
}

}  // namespace

void add_shape_routes(Router& router, const HubSite& site) {
  const auto add = [&](const char* path, HttpResponse (*answer)(const HubSite&, const ScanId&)) {
    router.add({"GET", path, Role::view, 0, [&site, answer](const HttpRequest& request) {
                  return with_scan(site.store, request,
                                   [&](Store&, const StoredScan& scan) { return answer(site, scan.id); });
                }});
  };
  add("/api/v1/scans/{id}/shape", answer_shape);
  add("/api/v1/scans/{id}/mesh", answer_mesh);
  add("/api/v1/scans/{id}/picture", answer_picture);
}

}  // namespace traygauge
