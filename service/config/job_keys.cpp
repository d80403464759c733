#include "service/config/config_sections.h"
#include "service/config/key_makers.h"

namespace farhorizon {

std::vector<ConfigKey> JobKeys() {
  const auto jobs = [](auto... fields) { return FieldAt(&Config::jobs, fields...); };
  const auto keep = [](auto field) {
    return FieldAt(&Config::jobs, &JobServiceOptions::retention, field);
  };
  return {
      NumberKey("jobs.maxWaiting", jobs(&JobServiceOptions::max_waiting), 1, 1'000'000,
                "jobs that may wait; more are refused with 503"),
      NumberKey(
          "jobs.maxWaitingPerClient", jobs(&JobServiceOptions::max_waiting_per_client), 0,
          1'000'000,
          "of these, jobs of one client: of an owner of keys, or of one address; more get 429; "
          "0: all "
          "but an eighth"),
      NumberKey("jobs.maxPosts", jobs(&JobServiceOptions::runner, &RunnerOptions::max_posts), 4,
                1'000'000'000, "largest DEM taken, in posts; larger ones get 413"),
      NumberKey("jobs.minFreeBytes", jobs(&JobServiceOptions::min_free_bytes), 0, kTebibyte,
                "room on the disk below which uploads are refused with 507"),
      NumberKey("jobs.keepSeconds", keep(&Retention::seconds), 0, 100 * 365 * kDay,
                "time that a job and its results are kept after its end; 0: without end"),
      NumberKey("jobs.keepJobs", keep(&Retention::jobs), 0, 1'000'000'000,
                "jobs that have ended that are kept, the newest; 0: all"),
      NumberKey("jobs.keepBytes", keep(&Retention::bytes), 0, 1024 * kTebibyte,
                "bytes of uploads and results that are kept, the newest jobs'; 0: all"),
      NumberKey(
          "jobs.memoryBytes", jobs(&JobServiceOptions::memory_bytes), 0, 1024 * kTebibyte,
          "memory of all workers and probes together: jobs wait for room in it; 0: that of the "
          "machine or its control group but 128 MiB and a sixteenth"),
      ChoiceKey("jobs.highestPriority", jobs(&JobServiceOptions::highest_priority), kPriorityNames,
                "highest priority that a client may ask for"),
      NumberKey("jobs.deadlineSeconds", jobs(&JobServiceOptions::deadline_seconds), 0, 366 * kDay,
                "deadline of a job that comes without one; 0: none"),
      NumberKey(
          "jobs.maxWatches", jobs(&JobServiceOptions::max_watches), 0, 1'000'000,
          "requests at once that wait for changes of jobs: event streams, Prefer: wait; of one "
          "client all but an eighth"),
      NumberKey("jobs.drainSeconds", FieldAt(&Config::drain_time), 0, kDay,
                "time that running jobs get to end when the service is stopped"),
  };
}

std::vector<ConfigKey> UploadKeys() {
  const auto uploads = [](auto... fields) {
    return FieldAt(&Config::jobs, &JobServiceOptions::uploads, fields...);
  };
  const auto bound = [&](auto field) { return uploads(&UploadOptions::bounds, field); };
  return {
      NumberKey("uploads.max", bound(&UploadBounds::all), 0, 1'000'000,
                "resumable uploads that no job has yet; more get 503"),
      NumberKey("uploads.maxPerClient", bound(&UploadBounds::of_client), 0, 1'000'000,
                "of these, uploads of one client: of an owner of keys, or of one address; more get "
                "429"),
      NumberKey("uploads.maxBytes", bound(&UploadBounds::bytes), 0, 1024 * kTebibyte,
                "bytes of all of these by their lengths, http.maxBodyBytes where one is not known"),
      NumberKey("uploads.maxBytesPerClient", bound(&UploadBounds::bytes_of_client), 0,
                1024 * kTebibyte, "of these, bytes of one client's"),
      NumberKey(
          "uploads.keepSeconds", uploads(&UploadOptions::keep_seconds), 1, 366 * kDay,
          "time that an upload is kept after the last bytes that came, and after the last job "
          "that was made of it"),
  };
}

std::vector<ConfigKey> StoreKeys() {
  const auto store = [](auto... fields) {
    return FieldAt(&Config::jobs, &JobServiceOptions::store, fields...);
  };
  const auto s3 = [&](auto field) { return store(&StoreOptions::s3, field); };
  return {
      TextKey(
          "store.jobs", store(&StoreOptions::jobs),
          "the URL of a PostgreSQL database that services share; empty: jobs.sqlite in the data "
          "folder"),
      TextKey("store.objects", store(&StoreOptions::objects),
              "uploads and results that the services share: a folder, or s3://BUCKET or "
              "s3://BUCKET/PREFIX; empty: in the data folder"),
      TextKey(
          "store.s3Endpoint", s3(&S3Options::endpoint),
          "the address of S3-compatible storage, http(s)://HOST:PORT; empty: AWS_ENDPOINT_URL_S3, "
          "AWS_ENDPOINT_URL, or Amazon's of the region"),
      TextKey("store.s3Region", s3(&S3Options::region),
              "its region; empty: AWS_REGION, AWS_DEFAULT_REGION, us-east-1"),
      ChoiceKey("store.s3Addressing", s3(&S3Options::addressing), kS3AddressingNames,
                "where a request names the bucket; auto: in the host's name at Amazon, else in the "
                "path"),
      TextKey("store.s3Credentials", s3(&S3Options::credentials),
              "a file of keys as Amazon's programs have it, read again when it changes; empty: "
              "AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, AWS_SESSION_TOKEN, or "
              "AWS_SHARED_CREDENTIALS_FILE"),
      NumberKey("store.cacheBytes", store(&StoreOptions::cache_bytes), 0, kTebibyte,
                "copies of a bucket's objects in the data folder; less where its disk is short"),
      NumberKey("store.leaseSeconds", store(&StoreOptions::lease_seconds), 2, 3600,
                "time after which a job of a service that does not answer runs elsewhere"),
      NumberKey(
          "store.connections", store(&StoreOptions::connections), 1, 1000,
          "connections to the database, for calls; as many again for uploads and results that "
          "are being stored"),
  };
}

std::vector<ConfigKey> WorkerKeys() {
  const auto runner = [](auto... fields) {
    return FieldAt(&Config::jobs, &JobServiceOptions::runner, fields...);
  };
  const auto limit = [&](auto field) { return runner(&RunnerOptions::limits, field); };
  const auto probe = [](auto field) {
    return FieldAt(&Config::jobs, &JobServiceOptions::probe, field);
  };
  return {
      TextKey("worker.program", runner(&RunnerOptions::worker_program),
              "the program that does a job's work: this one"),
      NumberKey("worker.threads", runner(&RunnerOptions::threads), 1, 1024,
                "threads of each worker"),
      NumberKey("worker.memoryBytes", limit(&WorkerLimits::memory_bytes), 1 << 27, kTebibyte,
                "memory of a worker at most; DEMs that are expected to need more get 422"),
      NumberKey("worker.wallSeconds", limit(&WorkerLimits::wall_seconds), 1, 30 * kDay,
                "time that a job may take"),
      NumberKey("worker.cpuSeconds", limit(&WorkerLimits::cpu_seconds), 1, 30 * kDay,
                "processor time that a job may take, of all threads together"),
      NumberKey("worker.fileBytes", limit(&WorkerLimits::file_bytes), 1 << 20, kTebibyte,
                "largest file that a worker may write"),
      NumberKey("worker.folderBytes", limit(&WorkerLimits::folder_bytes), 1 << 20, 16 * kTebibyte,
                "room on the disk for all files of a worker"),
      TextKey(
          "sandbox.require", FieldAt(&Config::sandbox_require),
          "layers of the workers' sandbox without which the service does not start: none, all, or "
          "of namespaces, private-root, landlock, seccomp, with commas between"),
      NumberKey("probe.maxBytes", probe(&ProbeOptions::max_bytes), 0, kTebibyte,
                "largest upload that is read before its 201; larger ones are read by their job"),
      NumberKey("probe.memoryBytes", probe(&ProbeOptions::memory_bytes), 1 << 27, kTebibyte,
                "memory of that reading"),
      NumberKey("probe.atOnce", probe(&ProbeOptions::at_once), 0, 1024,
                "such readings at once; 0: as many as workers, in a quarter of the memory"),
      NumberKey("probe.wallSeconds", probe(&ProbeOptions::wall_seconds), 1, 3600,
                "time for that reading"),
  };
}

}  // namespace farhorizon
