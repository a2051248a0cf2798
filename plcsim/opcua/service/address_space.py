"""Makes the nodes of the controller in asyncua's address space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from asyncua import ua
from asyncua.common.structures104 import new_enum

from plcsim.opcua.model import Branch
from plcsim.opcua.service.values import VariableCodec
from st_types.types.derived import EnumerationType

if TYPE_CHECKING:
    from collections.abc import Iterable

    from asyncua import Server

    from plcsim.opcua.model import Leaf

NAMESPACE: Final = "urn:plcsim:{project}"

_COMPONENT: Final = ua.NodeId(ua.ObjectIds.HasComponent)
_PROPERTY: Final = ua.NodeId(ua.ObjectIds.HasProperty)
_OBJECT: Final = ua.NodeId(ua.ObjectIds.BaseObjectType)
_VARIABLE: Final = ua.NodeId(ua.ObjectIds.BaseDataVariableType)
_ANALOG: Final = ua.NodeId(ua.ObjectIds.AnalogItemType)
_UNIT_NAMESPACE: Final = "http://www.opcfoundation.org/UA/units/un/cefact"


class Nodes:
    """The nodes of a controller.

    Args:
        server: asyncua's, initialised.
        project: names the namespace.

    Attributes:
        index: of the namespace.
        codecs: of the variables, by node.
    """

    def __init__(self, server: Server, project: str) -> None:
        self._server = server
        self._project = project
        self.index = 0
        self.codecs: dict[ua.NodeId, VariableCodec] = {}
        self._enumerations: dict[str, ua.NodeId] = {}

    async def make(self, branches: Iterable[Branch]) -> None:
        """Make all nodes, below one object with the project's name."""
        self.index = await self._server.register_namespace(NAMESPACE.format(project=self._project))
        top = Branch(self._project, "::", "", list(branches))
        await self._object(self._server.nodes.objects.nodeid, top)

    async def _object(self, parent: ua.NodeId, branch: Branch) -> None:
        item = self._item(parent, branch.path, branch.name)
        item.NodeClass = ua.NodeClass.Object
        item.TypeDefinition = _OBJECT
        attributes = ua.ObjectAttributes()
        attributes.DisplayName = ua.LocalizedText(branch.name)
        attributes.Description = ua.LocalizedText(branch.type_name or branch.name)
        item.NodeAttributes = attributes
        await self._add(item)
        for child in branch.children:
            if isinstance(child, Branch):
                await self._object(item.RequestedNewNodeId, child)
            else:
                await self._variable(item.RequestedNewNodeId, child)

    async def _variable(self, parent: ua.NodeId, leaf: Leaf) -> None:
        codec = VariableCodec(leaf)
        note = leaf.note
        item = self._item(parent, leaf.tag.path, leaf.name)
        item.NodeClass = ua.NodeClass.Variable
        is_analog = bool(note.unit) or None not in (note.minimum, note.maximum)
        item.TypeDefinition = _ANALOG if is_analog else _VARIABLE
        attributes = ua.VariableAttributes()
        attributes.DisplayName = ua.LocalizedText(leaf.name)
        attributes.Description = ua.LocalizedText(note.description or leaf.tag.data_type.name)
        attributes.DataType = await self._data_type(codec)
        attributes.ValueRank = len(leaf.dimensions) or ua.ValueRank.Scalar
        attributes.ArrayDimensions = list(leaf.dimensions) or None
        access = {ua.AccessLevel.CurrentRead}
        if leaf.is_writable:
            access.add(ua.AccessLevel.CurrentWrite)
        mask = sum(level.mask for level in access)
        attributes.AccessLevel = attributes.UserAccessLevel = mask
        attributes.Historizing = False
        attributes.MinimumSamplingInterval = 0.0
        attributes.Value = codec.variant(bytes(leaf.tag.data_type.size))
        item.NodeAttributes = attributes
        await self._add(item)
        self.codecs[item.RequestedNewNodeId] = codec
        if is_analog:
            await self._properties(item.RequestedNewNodeId, leaf)

    async def _properties(self, parent: ua.NodeId, leaf: Leaf) -> None:
        """Give unit and range of the tag map (OPC 10000-8, 5.3.2.3)."""
        note = leaf.note
        if note.minimum is not None and note.maximum is not None:
            value: Any = ua.Range(note.minimum, note.maximum)
            await self._property(parent, leaf, "EURange", value, ua.ObjectIds.Range)
        if note.unit:
            value = ua.EUInformation(
                NamespaceUri=_UNIT_NAMESPACE,
                UnitId=-1,
                DisplayName=ua.LocalizedText(note.unit),
                Description=ua.LocalizedText(note.unit),
            )
            await self._property(
                parent, leaf, "EngineeringUnits", value, ua.ObjectIds.EUInformation
            )

    async def _property(
        self, parent: ua.NodeId, leaf: Leaf, name: str, value: Any, data_type: int
    ) -> None:
        item = ua.AddNodesItem()
        item.RequestedNewNodeId = ua.NodeId(f"{leaf.tag.path}.{name}", self.index)
        item.BrowseName = ua.QualifiedName(name, 0)
        item.ParentNodeId = parent
        item.ReferenceTypeId = _PROPERTY
        item.NodeClass = ua.NodeClass.Variable
        item.TypeDefinition = ua.NodeId(ua.ObjectIds.PropertyType)
        attributes = ua.VariableAttributes()
        attributes.DisplayName = ua.LocalizedText(name)
        attributes.DataType = ua.NodeId(data_type)
        attributes.ValueRank = ua.ValueRank.Scalar
        attributes.AccessLevel = attributes.UserAccessLevel = ua.AccessLevel.CurrentRead.mask
        attributes.Value = ua.Variant(value)
        item.NodeAttributes = attributes
        await self._add(item)

    async def _data_type(self, codec: VariableCodec) -> ua.NodeId:
        element = codec.leaf.element
        if not isinstance(element, EnumerationType):
            return codec.builtin.data_type
        if element.name not in self._enumerations:
            fields: list[str | ua.EnumField] = [
                ua.EnumField(Name=name, DisplayName=ua.LocalizedText(name), Value=value)
                for name, value in element.values.items()
            ]
            node = await new_enum(self._server, self.index, element.name, fields)
            for each, value in zip(fields, element.values.values(), strict=True):
                assert isinstance(each, ua.EnumField)
                each.Value = value  # new_enum counts from 0, whatever was given
            definition = ua.EnumDefinition()
            definition.Fields = fields
            await node.write_data_type_definition(definition)
            self._enumerations[element.name] = node.nodeid
        return self._enumerations[element.name]

    def _item(self, parent: ua.NodeId, path: str, name: str) -> ua.AddNodesItem:
        item = ua.AddNodesItem()
        item.RequestedNewNodeId = ua.NodeId(path, self.index)
        item.BrowseName = ua.QualifiedName(name, self.index)
        item.ParentNodeId = parent
        item.ReferenceTypeId = _COMPONENT
        return item

    async def _add(self, item: ua.AddNodesItem) -> None:
        (result,) = await self._server.iserver.isession.add_nodes([item])
        result.StatusCode.check()
