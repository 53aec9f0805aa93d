# docker build -t eyeray . && docker run --rm -v "$PWD:/scenes" -w /scenes eyeray SCENES
# verifies scenes on lavapipe (scripts/verify-in-ci). For another command: --entrypoint eyeray.
# The image holds the archive of scripts/bundle and nothing to build with. An archive in build/release is taken as it is; else it is built.
FROM debian:12-slim AS build
COPY . /eyeray
WORKDIR /eyeray
RUN ls build/release/eyeray-*.tar.gz || scripts/bundle
RUN mkdir /opt/eyeray && tar -xzf build/release/eyeray-*.tar.gz --strip-components=1 -C /opt/eyeray

FROM debian:12-slim
COPY --from=build /opt/eyeray /opt/eyeray
ENV PATH=/opt/eyeray/bin:$PATH
ENTRYPOINT ["verify-in-ci"]
